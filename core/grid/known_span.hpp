// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "core/grid/dense_map.hpp"

namespace topo::grid {

/// Cells [first, end), by index; empty when first == end.
struct CellSpan {
  std::size_t first = 0;
  std::size_t end = 0;
  [[nodiscard]] bool empty() const { return first == end; }
};

/// Span from the first to the last known cell within [from, to). Tests eight cells at once. Rows of a map of
/// corridors are half unknown, and a pass can skip that part.
inline CellSpan known_span(std::span<const CellState> cells, std::size_t from, std::size_t to) {
  static_assert(sizeof(CellState) == 1 && static_cast<int>(CellState::kUnknown) == 0);
  std::uint64_t eight = 0;
  for (; from + sizeof eight <= to; from += sizeof eight) {
    std::memcpy(&eight, &cells[from], sizeof eight);
    if (eight != 0) break;
  }
  while (from < to && cells[from] == CellState::kUnknown) ++from;
  for (; from + sizeof eight <= to; to -= sizeof eight) {
    std::memcpy(&eight, &cells[to - sizeof eight], sizeof eight);
    if (eight != 0) break;
  }
  while (from < to && cells[to - 1] == CellState::kUnknown) --to;
  return {from, to};
}

}  // namespace topo::grid
