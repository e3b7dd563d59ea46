// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/grid/cell.hpp"
#include "core/types/geometry.hpp"

namespace topo::grid {

class OccupancyGrid;

/// Rounds towards minus infinity. std::floor is a function call on targets that may lack an instruction for
/// it.
inline std::int32_t floor_of(double value) {
  const auto towards_zero = static_cast<std::int32_t>(value);
  return towards_zero - (static_cast<double>(towards_zero) > value ? 1 : 0);
}

/// Rectangle of the occupancy grid as one array, row by row from below (y up). At least one unknown cell
/// surrounds the known cells, so that analysis and route search need no border tests. Value type, independent
/// of the source grid.
struct DenseMap {
  CellBox box;  ///< of the cells in the array; empty for an empty grid
  double resolution_m = 0.05;
  std::vector<CellState> cells;

  [[nodiscard]] int width() const { return static_cast<int>(box.width()); }
  [[nodiscard]] int height() const { return static_cast<int>(box.height()); }
  [[nodiscard]] bool contains(CellIndex c) const {
    return c.x >= box.min.x && c.x <= box.max.x && c.y >= box.min.y && c.y <= box.max.y;
  }
  /// True for cells of the array's first and last rows and columns, which must be unknown.
  [[nodiscard]] bool is_on_border(CellIndex c) const {
    return c.x == box.min.x || c.x == box.max.x || c.y == box.min.y || c.y == box.max.y;
  }
  /// Precondition: contains(c).
  [[nodiscard]] std::size_t index(CellIndex c) const {
    return static_cast<std::size_t>(c.y - box.min.y) * static_cast<std::size_t>(width()) +
           static_cast<std::size_t>(c.x - box.min.x);
  }
  [[nodiscard]] CellIndex cell(std::size_t index) const {
    const auto w = static_cast<std::size_t>(width());
    return {box.min.x + static_cast<std::int32_t>(index % w),
            box.min.y + static_cast<std::int32_t>(index / w)};
  }
  [[nodiscard]] CellIndex cell_at(const types::Vector2& p_map) const {
    return {floor_of(p_map.x() / resolution_m), floor_of(p_map.y() / resolution_m)};
  }
  [[nodiscard]] types::Vector2 centre_of(CellIndex c) const {
    return {(c.x + 0.5) * resolution_m, (c.y + 0.5) * resolution_m};
  }
  /// Unknown outside the array.
  [[nodiscard]] CellState state(CellIndex c) const {
    return contains(c) ? cells[index(c)] : CellState::kUnknown;
  }
};

/// The known part of the grid with `margin` (at least 1) unknown cells around it. Linear in the known tiles
/// and the array.
DenseMap dense_map(const OccupancyGrid& grid, int margin = 1);

}  // namespace topo::grid
