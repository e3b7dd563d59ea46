// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/cell_run.hpp"

namespace topo::grid {

/// Runs of cells, row by row, and which of them hang together over sides and corners: regions of a map for
/// the price of their rows. Keeps its memory; one thread.
class JoinedRuns {
 public:
  /// None, of a map so wide.
  void clear(std::size_t width);

  /// The next one, in rising order; between two of a row there is a cell that is of neither.
  void add(CellRun run);

  /// Those of the cells from `first` on, one row's or a part of it, that are marked with 1 and not with 0.
  void add_marked(std::size_t first, std::span<const std::uint8_t> marks);

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(runs_.size()); }
  [[nodiscard]] const CellRun& operator[](std::uint32_t run) const { return runs_[run]; }

  /// The first of the runs that hang together with one.
  [[nodiscard]] std::uint32_t root_of(std::uint32_t run);

  /// The run that a cell is in. Precondition: there is one.
  [[nodiscard]] std::uint32_t run_of(std::uint32_t cell) const;

  /// Columns [left, right) and rows [low, high] of the map.
  struct Extent {
    std::uint32_t left, right, low, high;
  };

  /// What the runs span that hang together, at the number of the first of them.
  [[nodiscard]] std::vector<Extent> extents();

 private:
  std::uint32_t width_ = 1;
  std::vector<CellRun> runs_;
  std::vector<std::uint32_t> root_;  ///< of each run one that it hangs together with; itself: none before it
  std::uint32_t row_ = 0;            ///< of the last run
  std::uint32_t in_row_ = 0;         ///< first run of that row
  std::uint32_t beside_ = 0;         ///< first run of the row below that may touch the next one
};

}  // namespace topo::grid
