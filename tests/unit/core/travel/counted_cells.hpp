// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/grid/occupancy_grid.hpp"

namespace topo::travel {

/// A grid in which some cells have counts.
class CountedCells {
 public:
  CountedCells() : grid_(arena_, 0.05) {}
  void put(grid::CellIndex cell, std::uint16_t hits, std::uint16_t misses) {
    grid_.tile_to_change(cell.x >> 5, cell.y >> 5).cells[grid::Tile::index(cell.x & 31, cell.y & 31)] = {
        hits, misses};
  }
  [[nodiscard]] const grid::OccupancyGrid& grid() const { return grid_; }

 private:
  patricia::Arena<grid::TileRef> arena_;
  grid::OccupancyGrid grid_;
};

}  // namespace topo::travel
