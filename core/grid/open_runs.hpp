// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace topo::grid {

/// Which cells of a map hang together over eight neighbours, row by row in runs: whether there is a way from
/// one cell to others is known without looking for it. Keeps its memory; one thread.
class OpenRuns {
 public:
  struct Run {
    std::uint32_t first;  ///< cell
    std::uint32_t end;    ///< the cell after its last
  };

  /// Cells with a finite cost are open. `width` divides the number of cells. The first and the last cell of
  /// every row are closed, and so are the first and the last row. Costs one pass over the cells.
  void take(std::span<const float> cost, std::size_t width);

  /// Calls f(Run) for all runs that hang together with an open cell, in rising order.
  template <class F>
  void for_each_connected(std::uint32_t cell, F&& f) {
    const std::uint32_t root = root_of(run_of(cell));
    for (std::uint32_t run = 0; run < runs_.size(); ++run)
      if (root_of(run) == root) f(runs_[run]);
  }

 private:
  void add_runs(const float* row, std::uint32_t first_cell);
  void connect(std::size_t below, std::size_t above, std::size_t end, std::uint32_t width);
  [[nodiscard]] std::uint32_t run_of(std::uint32_t cell) const;
  [[nodiscard]] std::uint32_t root_of(std::uint32_t run);

  std::vector<Run> runs_;
  std::vector<std::uint32_t> root_;  ///< of each run one that it hangs together with; itself: none before it
  std::vector<std::uint8_t> is_open_;  ///< of one row, and a closed cell
};

}  // namespace topo::grid
