// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/types/geometry.hpp"

namespace topo::places {

/// Turns points of map into the compass frame.
struct CompassFrame {
  explicit CompassFrame(double compass_rad) : cos(std::cos(compass_rad)), sin(std::sin(compass_rad)) {}
  [[nodiscard]] types::Vector2 from_map(const types::Vector2& p) const {
    return {cos * p.x() + sin * p.y(), cos * p.y() - sin * p.x()};
  }
  [[nodiscard]] types::Vector2 to_map(const types::Vector2& p) const {
    return {cos * p.x() - sin * p.y(), cos * p.y() + sin * p.x()};
  }
  double cos;
  double sin;
};

/// How many occupied cells lie in a rectangle of the compass frame, in constant time: a table of sums over
/// bins of two by two cells.
class BoxCounts {
 public:
  BoxCounts(const grid::DenseMap& map, const CompassFrame& frame);
  [[nodiscard]] std::uint32_t occupied_in(const types::Rectangle& box) const;

 private:
  void sum_up();
  std::size_t columns_ = 1;
  std::size_t rows_ = 1;
  types::Vector2 corner_{0.0, 0.0};
  double bin_m_;
  std::vector<std::uint32_t> sums_;  ///< over all bins left of a column and below a row
};

}  // namespace topo::places
