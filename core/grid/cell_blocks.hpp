// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "core/grid/cell_run.hpp"

namespace topo::grid {

/// Set of cells at the resolution of blocks; iterates over the marked blocks in ascending order.
class CellBlocks {
 public:
  explicit CellBlocks(std::size_t cells) : cells_(cells), holds_((cells >> kShift) + 1, 0) {}

  void add(std::uint32_t cell) { holds_[cell >> kShift] = 1; }
  /// Adds all cells of a run that is not empty.
  void add(CellRun run) {
    std::fill(holds_.begin() + (run.first >> kShift), holds_.begin() + ((run.end - 1) >> kShift) + 1,
              std::uint8_t{1});
  }

  /// Calls f(first, end) for the cells of the marked blocks; adjacent marked blocks share one call.
  template <class F>
  void for_each(F&& f) const {
    for (std::size_t b = 0; (b = next(b)) < holds_.size();) {
      const std::size_t first = b;
      while (b < holds_.size() && holds_[b] != 0) ++b;
      f(first << kShift, std::min(b << kShift, cells_));
    }
  }

 private:
  /// The first marked block from `block` on. Most blocks are unmarked, and memchr tests many at once.
  [[nodiscard]] std::size_t next(std::size_t block) const {
    const void* const found =
        block < holds_.size() ? std::memchr(&holds_[block], 1, holds_.size() - block) : nullptr;
    if (found == nullptr) return holds_.size();
    return static_cast<std::size_t>(static_cast<const std::uint8_t*>(found) - holds_.data());
  }

  static constexpr unsigned kShift = 5;
  std::size_t cells_;
  std::vector<std::uint8_t> holds_;
};

}  // namespace topo::grid
