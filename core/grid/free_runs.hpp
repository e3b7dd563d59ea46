// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "core/grid/dense_map.hpp"

namespace topo::grid {

/// Adjacent free cells [first, end), by index.
struct FreeRun {
  CellIndex cell;  ///< the first
  std::size_t first = 0;
  std::size_t end = 0;
};

/// The first cell from `i` on that is not free, or `end`. Tests eight cells at once.
inline std::size_t end_of_free(std::span<const CellState> cells, std::size_t i, std::size_t end) {
  static_assert(sizeof(CellState) == 1);
  constexpr std::uint64_t kAllFree = 0x0101010101010101U * static_cast<std::uint64_t>(CellState::kFree);
  for (std::uint64_t eight = 0; i + sizeof eight <= end; i += sizeof eight) {
    std::memcpy(&eight, &cells[i], sizeof eight);
    if (eight != kAllFree) break;
  }
  while (i < end && cells[i] == CellState::kFree) ++i;
  return i;
}

/// Calls f(first, end) for each run of free cells within [from, to), in ascending order. Other cells cost
/// next to nothing: memchr tests many at once.
template <class F>
void for_each_free_run(std::span<const CellState> cells, std::size_t from, std::size_t to, F&& f) {
  while (from < to) {
    const void* const found = std::memchr(&cells[from], static_cast<int>(CellState::kFree), to - from);
    if (found == nullptr) return;
    const auto first = static_cast<std::size_t>(static_cast<const CellState*>(found) - cells.data());
    from = end_of_free(cells, first, to);
    f(first, from);
  }
}

/// Calls f(FreeRun) for each run of free cells of a map, row by row.
template <class F>
void for_each_free_run(const DenseMap& map, F&& f) {
  const auto width = static_cast<std::size_t>(map.width());
  std::int32_t y = map.box.min.y;
  for (std::size_t row = 0; row < map.cells.size(); row += width, ++y) {
    for_each_free_run(map.cells, row, row + width, [&](std::size_t first, std::size_t end) {
      f(FreeRun{{map.box.min.x + static_cast<std::int32_t>(first - row), y}, first, end});
    });
  }
}

}  // namespace topo::grid
