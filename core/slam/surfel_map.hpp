// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/slam/cloud.hpp"

namespace topo::slam {

/// Surfels of several keyframes in one frame, with the nearest one found in constant time: each surfel claims
/// the cells around it for which it is the nearest, so that a lookup is one load. Sized for what it holds:
/// a window of the map, not the map.
class SurfelMap {
 public:
  /// `reach_m`: how far from a surfel a point still finds it.
  explicit SurfelMap(double reach_m, double cell_m = 0.10);

  /// Empties the map and centres a window of the given half width on `centre`. Keeps its memory.
  void reset(const Point& centre, double half_width_m);

  /// Adds a keyframe's surfels, given in its base_link, at its pose. Those outside the window are left out.
  void add(std::span<const Surfel> surfels, const types::Se2& T_map_base);

  /// The surfel nearest to the centre of p's cell, or null beyond its reach or outside the window.
  [[nodiscard]] const Surfel* nearest(const Point& p) const {
    const float fx = (p.x() - origin_.x()) * inverse_cell_, fy = (p.y() - origin_.y()) * inverse_cell_;
    if (!(fx >= 0.0F && fy >= 0.0F)) return nullptr;
    const auto ix = static_cast<std::uint32_t>(fx), iy = static_cast<std::uint32_t>(fy);
    if (ix >= width_ || iy >= width_) return nullptr;
    const std::int32_t index = cells_[iy * width_ + ix].surfel;
    return index < 0 ? nullptr : &surfels_[static_cast<std::size_t>(index)];
  }

  [[nodiscard]] std::span<const Surfel> surfels() const { return surfels_; }
  [[nodiscard]] const Point& origin() const { return origin_; }
  [[nodiscard]] double width_m() const { return width_ * static_cast<double>(cell_); }

 private:
  struct Cell {
    std::int32_t surfel = -1;
    float distance2 = 0.0F;
  };
  void claim(std::int32_t index);

  float reach_, cell_, inverse_cell_;
  Point origin_ = Point::Zero();  ///< lower left corner
  std::uint32_t width_ = 0;
  std::vector<Cell> cells_;
  std::vector<Surfel> surfels_;
};

}  // namespace topo::slam
