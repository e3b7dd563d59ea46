// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "core/types/result.hpp"
#include "tests/sim/laser.hpp"
#include "tests/sim/raster.hpp"
#include "tests/sim/world.hpp"

namespace topo::sim {

struct Colour {
  std::uint8_t red, green, blue;
};

inline constexpr Colour kWallInk{30, 30, 30};
inline constexpr Colour kTruthInk{20, 110, 220};
inline constexpr Colour kEstimateInk{220, 40, 40};
inline constexpr Colour kScanInk{0, 150, 60};

/// Picture of a part of the plane, y upwards, for reports.
class Picture {
 public:
  /// Limited to 4000 pixels per side by a coarser scale.
  Picture(const types::Rectangle& area, double metres_per_pixel);

  void dot(const Vector2& p, Colour colour, int radius_px = 0);
  void line(const Vector2& a, const Vector2& b, Colour colour);
  void fill(const Polygon& polygon, Colour colour);
  /// Mixes the cells of the raster that are not 0 half with the present colours.
  void tint(const Raster& raster, Colour colour);
  /// Walls dark, low objects brown, hanging objects violet, glass blue.
  void world(const World& world);
  void path(std::span<const Se2> poses, Colour colour);
  /// The scan's end points at the given pose.
  void sweep(const Sweep& sweep, const LaserModel& model, const LaserMount& mount, const Se2& pose,
             Colour colour);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] Colour at(const Vector2& p) const;
  types::Status save_png(const std::filesystem::path& file) const;

 private:
  [[nodiscard]] int column(double x_m) const;
  [[nodiscard]] int row(double y_m) const;
  void set(int x, int y, Colour colour);

  types::Rectangle area_;
  double scale_m_;
  int width_, height_;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace topo::sim
