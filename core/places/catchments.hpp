// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/places/slopes.hpp"

namespace topo::places {

/// Finds the cells whose label hangs on something that has changed.
///
/// A cell's label hangs on the way up from it to the axis; where that way is flat, on which neighbours were
/// labelled before, and so on the ways that lead to those. Both go from cell to cell along slopes and across
/// what is flat, and none goes through the axis. So whatever is connected in this manner, up and down, with a
/// cell that has changed or was beside it is labelled anew, and nothing else.
class Catchments {
 public:
  /// `slopes` with kOnAxis on the axis; kVisited marks what is found.
  Catchments(const grid::DenseMap& map, std::vector<Slope>& slopes);

  /// This cell's slope has changed, or what it is to the axis. It is not at the array's border.
  void spread_from(std::uint32_t cell);

  /// All that were found, of [first, end) rows of cells, each no wider than need be.
  struct Span {
    std::uint32_t first = UINT32_MAX, end = 0;
  };
  [[nodiscard]] const std::vector<Span>& rows() const { return rows_; }

 private:
  void visit(std::uint32_t i);
  void spread();
  [[nodiscard]] std::uint32_t beside(std::uint32_t i, std::size_t k) const {
    return static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(i) + offsets_[k]);
  }

  Slope* slopes_;
  std::uint32_t width_;
  std::array<std::ptrdiff_t, 8> offsets_;
  std::vector<Span> rows_;
  std::vector<std::uint32_t> queue_;
};

}  // namespace topo::places
