// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <utility>

#include "core/grid/occupancy_grid.hpp"
#include "core/walls/wall_store.hpp"

namespace topo::slam::testing {

/// What is known of a grid, to be compared.
inline std::map<std::pair<int, int>, grid::CellState> states(const grid::OccupancyGrid& grid) {
  std::map<std::pair<int, int>, grid::CellState> out;
  grid.for_each_known([&](grid::CellIndex cell, grid::CellState state) { out[{cell.x, cell.y}] = state; });
  return out;
}

inline std::map<patricia::Key, walls::Slabs> columns(const walls::WallStore& walls) {
  std::map<patricia::Key, walls::Slabs> out;
  walls.columns().for_each([&](patricia::Key key, walls::Slabs slabs) { out[key] = slabs; });
  return out;
}

}  // namespace topo::slam::testing
