// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstring>

#include "core/grid/dense_map.hpp"

namespace topo::grid {

/// Free cells side by side, by their indices.
struct FreeRun {
  CellIndex cell;  ///< the first
  std::size_t first = 0;
  std::size_t end = 0;
};

/// Calls f(FreeRun) for all free cells, in rising order. What is not free costs next to nothing: the library
/// looks at many cells at once.
template <class F>
void for_each_free_run(const DenseMap& map, F&& f) {
  static_assert(sizeof(CellState) == 1);
  const auto width = static_cast<std::size_t>(map.width());
  const CellState* const cells = map.cells.data();
  std::int32_t y = map.box.min.y;
  for (std::size_t i = 0, row_end = width; i < map.cells.size(); i = row_end, row_end += width, ++y) {
    const std::size_t row = i;
    while (i < row_end) {
      const void* const found = std::memchr(cells + i, static_cast<int>(CellState::kFree), row_end - i);
      if (found == nullptr) break;
      const auto first = static_cast<std::size_t>(static_cast<const CellState*>(found) - cells);
      for (i = first + 1; i < row_end && cells[i] == CellState::kFree;) ++i;
      f(FreeRun{{map.box.min.x + static_cast<std::int32_t>(first - row), y}, first, i});
    }
  }
}

}  // namespace topo::grid
