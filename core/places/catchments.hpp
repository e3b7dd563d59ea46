// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/places/slopes.hpp"

namespace topo::places {

/// Cells in blocks, so that those with something in them are found again in rising order.
class CellBlocks {
 public:
  explicit CellBlocks(std::size_t cells) : cells_(cells), holds_((cells >> kShift) + 1, 0) {}

  void add(std::uint32_t cell) { holds_[cell >> kShift] = 1; }

  /// Calls f(first, end) for the cells of each block to which one was added.
  template <class F>
  void for_each(F&& f) const {
    for (std::size_t b = 0; b < holds_.size(); ++b)
      if (holds_[b] != 0) f(b << kShift, std::min((b + 1) << kShift, cells_));
  }

 private:
  static constexpr unsigned kShift = 7;
  std::size_t cells_;
  std::vector<std::uint8_t> holds_;
};

/// The cells whose label hangs on one of these, each with another slope than before or another relation to
/// the axis, none at the array's border. They are marked kVisited in `slopes`; returned is where they are.
///
/// A cell's label hangs on the way up from it to the axis; where that way is flat, on which neighbours were
/// labelled before, and so on the ways that lead to those. Both go from cell to cell along slopes and across
/// what is flat, and none goes through the axis. So whatever is connected in this manner, up and down, with a
/// cell that has changed or was beside it is labelled anew, and nothing else.
CellBlocks find_catchments(const grid::DenseMap& map, std::span<const std::uint32_t> changed,
                           std::vector<Slope>& slopes);

}  // namespace topo::places
