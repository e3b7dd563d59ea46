// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rapidcheck.h>

#include <algorithm>

#include "core/grid/dense_map.hpp"

namespace topo::places {

/// Patches of the three states anywhere but on the margin.
inline void draw_patches(grid::DenseMap& map, int count, int side_max) {
  const grid::CellIndex min{map.box.min.x + 1, map.box.min.y + 1}, max{map.box.max.x, map.box.max.y};
  for (int k = 0; k < count; ++k) {
    const int x0 = *rc::gen::inRange(min.x, max.x), y0 = *rc::gen::inRange(min.y, max.y);
    const int x1 = std::min(x0 + *rc::gen::inRange(1, side_max), max.x),
              y1 = std::min(y0 + *rc::gen::inRange(1, side_max), max.y);
    const auto state =
        *rc::gen::element(grid::CellState::kOccupied, grid::CellState::kUnknown, grid::CellState::kFree);
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) map.cells[map.index({x, y})] = state;
  }
}

}  // namespace topo::places
