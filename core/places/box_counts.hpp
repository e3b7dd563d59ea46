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
    return cos * p + sin * types::Vector2(p.y(), -p.x());
  }
  [[nodiscard]] types::Vector2 to_map(const types::Vector2& p) const {
    return {cos * p.x() - sin * p.y(), cos * p.y() + sin * p.x()};
  }
  double cos;
  double sin;
};

/// How many occupied cells lie in a rectangle of the compass frame, in constant time, over bins of two by two
/// cells: of tables of sums along the columns and, of blocks of columns, along the rows. One sum over both
/// would take longer to make than all that is asked of it: along a row each waits for the one before it.
class BoxCounts {
 public:
  BoxCounts(const grid::DenseMap& map, const CompassFrame& frame);
  [[nodiscard]] std::uint32_t occupied_in(const types::Rectangle& box) const;

 private:
  void sum_up();
  [[nodiscard]] std::uint32_t occupied_up_to(std::size_t column, std::size_t row) const;

  static constexpr std::size_t kBlock = 16;
  std::size_t columns_ = kBlock;  ///< whole blocks
  std::size_t rows_ = 1;
  types::Vector2 corner_{0.0, 0.0};
  double bin_m_;
  std::vector<std::uint32_t> along_columns_;  ///< over a column's bins up to a row
  std::vector<std::uint32_t> before_blocks_;  ///< over all bins up to a row and left of a block of columns
};

}  // namespace topo::places
