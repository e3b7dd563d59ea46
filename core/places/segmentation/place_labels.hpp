// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/grid/dense_map.hpp"

namespace topo::places {

/// The label of every cell of a map, 0 for none, as runs of adjacent cells. Needs half a byte or less per
/// labelled cell, and nothing for the others. A value.
class PlaceLabels {
 public:
  /// Labels the cells [first, end), which lie behind all labelled ones. `label`: not 0.
  void append(std::uint32_t first, std::uint32_t end, std::uint16_t label);

  [[nodiscard]] bool empty() const { return runs_.empty(); }
  /// The label of a cell of the map, by index. Almost constant time.
  [[nodiscard]] std::uint16_t operator[](std::size_t cell) const;
  /// The labels of all cells of a map with this number of cells.
  [[nodiscard]] std::vector<std::uint16_t> by_cell(std::size_t cells) const;
  /// A copy without the cells that are not free in `map`, to which the labels belong.
  [[nodiscard]] PlaceLabels on_free_cells(const grid::DenseMap& map) const;

  friend bool operator==(const PlaceLabels&, const PlaceLabels&) = default;

 private:
  struct Run {
    std::uint32_t first, end;
    std::uint16_t label;
    friend bool operator==(const Run&, const Run&) = default;
  };

  static constexpr unsigned kShift = 9;  ///< blocks of 512 cells: a few runs each
  std::vector<Run> runs_;
  std::vector<std::uint32_t> starts_;  ///< for each block of cells the first run that reaches into it or lies
                                       ///< beyond it
};

}  // namespace topo::places
