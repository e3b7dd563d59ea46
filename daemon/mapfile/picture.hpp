// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/types/result.hpp"
#include "core/types/se2.hpp"
#include "daemon/mapfile/map_image.hpp"

namespace topo::daemon {

struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;
  friend bool operator==(const Rgb&, const Rgb&) = default;
};

/// A coloured raster, top row first. Drawing outside is clipped.
class Picture {
 public:
  /// Precondition: both sides are from 1 to MapImage::kMaxSide.
  Picture(int width, int height, Rgb fill);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// Precondition: the pixel is inside.
  [[nodiscard]] Rgb at(int x, int y) const { return pixels_[index(x, y)]; }
  [[nodiscard]] std::span<const Rgb> pixels() const { return pixels_; }

  void set(int x, int y, Rgb colour);
  void line(int x0, int y0, int x1, int y1, Rgb colour);
  void disc(int x, int y, int radius, Rgb colour);

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  int width_;
  int height_;
  std::vector<Rgb> pixels_;
};

/// The map in white (free), black (occupied) and grey (unknown), one pixel per cell.
[[nodiscard]] Picture picture_of(const MapImage& map);

/// Draws a path given in map: a line, with a disc at each end.
void draw_path(Picture& picture, const MapImage& map, std::span<const types::Se2> path, Rgb colour);

/// Writes the picture as a PNG file, atomically. Blocks on the disk. Errors name the file.
types::Status save_png(const std::string& path, const Picture& picture);

}  // namespace topo::daemon
