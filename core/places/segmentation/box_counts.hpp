// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/types/geometry.hpp"

namespace topo::places {

/// Transforms points from map into the compass frame and back.
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

/// Number of occupied cells in a rectangle of the compass frame, in constant time, with bins of two by two
/// cells. One table holds sums along the columns, another one sums of blocks of columns along the rows. A
/// single table of sums over both axes would take longer to build than all queries: along a row each sum
/// depends on the previous one. A value.
class BoxCounts {
 public:
  BoxCounts(const grid::DenseMap& map, const CompassFrame& frame);

  [[nodiscard]] std::uint32_t occupied_in(const types::Rectangle& box) const;

 private:
  struct Bin {
    std::size_t column, row;
  };
  [[nodiscard]] types::Vector2 row_start(int y) const;
  /// The bin of a cell with this offset from its row's first cell.
  [[nodiscard]] Bin bin_of(const types::Vector2& row_start, double x) const;
  void sum_up();
  [[nodiscard]] std::uint32_t occupied_up_to(std::size_t column, std::size_t row) const;

  static constexpr std::size_t kBlock = 16;  ///< columns summed by one vectorised loop
  grid::CellBox box_;
  double resolution_m_;
  CompassFrame frame_;
  std::size_t columns_ = kBlock;  ///< a multiple of kBlock
  std::size_t rows_ = 1;
  types::Vector2 corner_{0.0, 0.0};
  double bin_m_;
  std::vector<std::uint32_t> along_columns_;  ///< sum of a column's bins up to a row
  std::vector<std::uint32_t> before_blocks_;  ///< sum of all bins up to a row and left of a block of columns
};

}  // namespace topo::places
