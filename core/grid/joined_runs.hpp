// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/cell_run.hpp"

namespace topo::grid {

/// Runs of cells, row by row, and their connected components over sides and corners: regions of a map at the
/// cost of their rows. Keeps its memory. Single-threaded.
class JoinedRuns {
 public:
  /// Removes all runs; `width`: cells per row of the map.
  void clear(std::size_t width);

  /// Adds the next run, in ascending order. At least one cell must separate two runs of a row.
  void add(CellRun run);

  /// Adds the runs of cells marked 1 (the others are marked 0), from cell `first` on, within one row.
  void add_marked(std::size_t first, std::span<const std::uint8_t> marks);

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(runs_.size()); }
  [[nodiscard]] const CellRun& operator[](std::uint32_t run) const { return runs_[run]; }

  /// First run of the component that contains `run`.
  [[nodiscard]] std::uint32_t root_of(std::uint32_t run);

  /// The run that contains a cell. Precondition: there is one.
  [[nodiscard]] std::uint32_t run_of(std::uint32_t cell) const;

  /// Columns [left, right) and rows [low, high] of the map.
  struct Extent {
    std::uint32_t left, right, low, high;
  };

  /// Extents of the components, each at the number of its first run.
  [[nodiscard]] std::vector<Extent> extents();

 private:
  std::uint32_t width_ = 1;
  std::vector<CellRun> runs_;
  std::vector<std::uint32_t> root_;  ///< parent of each run in its component; itself for the first run
  std::uint32_t row_ = 0;            ///< row of the last run
  std::uint32_t in_row_ = 0;         ///< first run of that row
  std::uint32_t beside_ = 0;         ///< first run of the row below that may touch the next one
};

}  // namespace topo::grid
