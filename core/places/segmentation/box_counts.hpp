// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/grid/clearance_update.hpp"
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
  friend bool operator==(const CompassFrame&, const CompassFrame&) = default;
  double cos;
  double sin;
};

/// How many occupied cells lie in a rectangle of the compass frame, in constant time, over bins of two by two
/// cells: of tables of sums along the columns and, of blocks of columns, along the rows. One sum over both
/// would take longer to make than all that is asked of it: along a row each waits for the one before it.
/// A value.
class BoxCounts {
 public:
  BoxCounts(const grid::DenseMap& map, const CompassFrame& frame);

  /// Are bins of this map where they are here?
  [[nodiscard]] bool fits(const grid::DenseMap& map, const CompassFrame& frame) const {
    return box_ == map.box && resolution_m_ == map.resolution_m && frame_ == frame;
  }
  /// Makes of the counts of a map those of one that fits and differs from it in these cells. Costs the rows
  /// from the lowest of them up: their columns, and the blocks to the right end.
  void change(const grid::OccupiedChange& cells);

  [[nodiscard]] std::uint32_t occupied_in(const types::Rectangle& box) const;

 private:
  struct Bin {
    std::size_t column, row;
  };
  /// One more or one less.
  struct Step {
    Bin bin;
    std::uint32_t by;  ///< modulo 2 to the power of 32
  };

  [[nodiscard]] types::Vector2 row_start(int y) const;
  /// Of a cell so far from its row's first.
  [[nodiscard]] Bin bin_of(const types::Vector2& row_start, double x) const;
  [[nodiscard]] std::vector<Step> steps_of(const grid::OccupiedChange& cells) const;
  void sum_up();
  [[nodiscard]] std::uint32_t occupied_up_to(std::size_t column, std::size_t row) const;

  static constexpr std::size_t kBlock = 16;
  grid::CellBox box_;
  double resolution_m_;
  CompassFrame frame_;
  std::size_t columns_ = kBlock;  ///< whole blocks
  std::size_t rows_ = 1;
  types::Vector2 corner_{0.0, 0.0};
  double bin_m_;
  std::vector<std::uint32_t> along_columns_;  ///< over a column's bins up to a row
  std::vector<std::uint32_t> before_blocks_;  ///< over all bins up to a row and left of a block of columns
};

}  // namespace topo::places
