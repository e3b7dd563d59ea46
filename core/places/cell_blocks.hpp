// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace topo::places {

/// Cells in blocks, so that those with something in them are found again in rising order.
class CellBlocks {
 public:
  explicit CellBlocks(std::size_t cells) : cells_(cells), holds_((cells >> kShift) + 1, 0) {}

  void add(std::uint32_t cell) { holds_[cell >> kShift] = 1; }

  /// Calls f(first, end) for the cells of blocks to which one was added, those of neighbouring blocks at
  /// once.
  template <class F>
  void for_each(F&& f) const {
    for (std::size_t b = 0; b < holds_.size();) {
      const std::size_t first = b++;
      if (holds_[first] == 0) continue;
      while (b < holds_.size() && holds_[b] != 0) ++b;
      f(first << kShift, std::min(b << kShift, cells_));
    }
  }

 private:
  static constexpr unsigned kShift = 7;
  std::size_t cells_;
  std::vector<std::uint8_t> holds_;
};

}  // namespace topo::places
