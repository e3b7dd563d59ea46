// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>

#include "core/grid/occupancy_grid.hpp"

namespace topo::grid {

/// Calls f(y, x, count), row by row, for each block of at most `block` adjacent cells in which two maps
/// differ. Both maps have the same number of rows of `width` cells. Equal cells cost next to nothing: memcmp
/// compares many at once.
template <class F>
void for_each_other_block(std::span<const CellState> a, std::span<const CellState> b, std::size_t width,
                          std::size_t block, F&& f) {
  static_assert(sizeof(CellState) == 1);
  for (std::size_t y = 0, row = 0; row < a.size(); ++y, row += width) {
    if (std::memcmp(&a[row], &b[row], width) == 0) continue;
    for (std::size_t x = 0; x < width; x += block) {
      const std::size_t count = std::min(block, width - x);
      if (std::memcmp(&a[row + x], &b[row + x], count) != 0) f(y, x, count);
    }
  }
}

}  // namespace topo::grid
