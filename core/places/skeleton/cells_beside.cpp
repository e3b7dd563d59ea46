// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/skeleton/cells_beside.hpp"

#include <algorithm>

namespace topo::places {
namespace {

using grid::CellRun;

/// Runs of the cells, extended by a cell at both ends, without the ends of their row.
std::vector<CellRun> widened_runs(std::span<const std::uint32_t> cells, std::uint32_t width) {
  std::vector<CellRun> runs;
  for (std::size_t k = 0; k < cells.size();) {
    const std::uint32_t first = cells[k], row = first / width * width;
    std::uint32_t end = first + 1;
    while (++k < cells.size() && cells[k] == end && end < row + width) ++end;
    const CellRun run{std::max(first, row + 2) - 1, std::min(end + 1, row + width - 1)};
    if (run.first < run.end) runs.push_back(run);
  }
  return runs;
}

/// Joins runs that overlap or touch. Ascending by first cell.
std::vector<CellRun> united(std::span<const CellRun> runs) {
  std::vector<CellRun> out;
  for (const CellRun& run : runs) {
    if (!out.empty() && run.first <= out.back().end)
      out.back().end = std::max(out.back().end, run.end);
    else
      out.push_back(run);
  }
  return out;
}

}  // namespace

std::vector<CellRun> cells_and_beside(const grid::DenseMap& map, std::span<const std::uint32_t> cells) {
  const auto width = static_cast<std::uint32_t>(map.width());
  const auto size = static_cast<std::uint32_t>(map.cells.size());
  const std::vector<CellRun> level = widened_runs(cells, width);
  const auto begins_before = [](const CellRun& a, const CellRun& b) { return a.first < b.first; };
  std::vector<CellRun> all;
  for (const std::uint32_t rows : {0U, 1U, 2U}) {  // beginning with the row below
    const auto middle = static_cast<std::ptrdiff_t>(all.size());
    for (const CellRun& run : level) {
      const std::uint32_t first = run.first + rows * width, end = run.end + rows * width;
      // Shifted up by one row, so that no index is negative.
      if (first >= 2 * width && end <= size) all.push_back({first - width, end - width});
    }
    std::inplace_merge(all.begin(), all.begin() + middle, all.end(), begins_before);
  }
  return united(all);
}

}  // namespace topo::places
