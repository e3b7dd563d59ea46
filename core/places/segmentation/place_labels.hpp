// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/grid/dense_map.hpp"

namespace topo::places {

/// The label of every cell of a map, 0 for none, in runs of cells side by side: memory for half a byte a
/// labelled cell or less, and none for the others. A value.
class PlaceLabels {
 public:
  /// Labels the cells [first, end), which lie behind all that have one. `label`: not 0.
  void append(std::uint32_t first, std::uint32_t end, std::uint16_t label);

  [[nodiscard]] bool empty() const { return runs_.empty(); }
  /// Of a cell of the map, by its index. Constant time, all but.
  [[nodiscard]] std::uint16_t operator[](std::size_t cell) const;
  /// Of every cell, of a map that has so many.
  [[nodiscard]] std::vector<std::uint16_t> by_cell(std::size_t cells) const;
  /// Without those of cells that are not free; `map`: the one with these cells.
  [[nodiscard]] PlaceLabels on_free_cells(const grid::DenseMap& map) const;

  friend bool operator==(const PlaceLabels&, const PlaceLabels&) = default;

 private:
  struct Run {
    std::uint32_t first, end;
    std::uint16_t label;
    friend bool operator==(const Run&, const Run&) = default;
  };

  static constexpr unsigned kShift = 9;
  std::vector<Run> runs_;
  std::vector<std::uint32_t> starts_;  ///< the first run that reaches into each block of cells, or beyond it
};

}  // namespace topo::places
