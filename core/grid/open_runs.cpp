// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/grid/open_runs.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

namespace topo::grid {

void OpenRuns::take(std::span<const float> cost, std::size_t width) {
  runs_.clear();
  root_.clear();
  if (width == 0) return;
  is_open_.assign(width + 1, 0);
  std::size_t below = 0;  // first run of the row before
  for (std::size_t at = 0; at < cost.size(); at += width) {
    const std::size_t above = runs_.size();
    add_runs(&cost[at], static_cast<std::uint32_t>(at));
    connect(below, above, runs_.size(), static_cast<std::uint32_t>(width));
    below = above;
  }
}

void OpenRuns::add_runs(const float* row, std::uint32_t first_cell) {
  const std::size_t width = is_open_.size() - 1;
  std::uint8_t* const is_open = is_open_.data();
  for (std::size_t x = 0; x < width; ++x)
    is_open[x] = row[x] < std::numeric_limits<float>::infinity() ? 1 : 0;
  const std::uint8_t* at = is_open;
  const auto next = [&](int value) {
    return static_cast<const std::uint8_t*>(
        std::memchr(at, value, static_cast<std::size_t>(is_open + width + 1 - at)));
  };
  while ((at = next(1)) != nullptr) {
    const auto first = first_cell + static_cast<std::uint32_t>(at - is_open);
    at = next(0);  // the one after the row at the latest
    root_.push_back(static_cast<std::uint32_t>(runs_.size()));
    runs_.push_back({first, first_cell + static_cast<std::uint32_t>(at - is_open)});
  }
}

/// Joins the runs [below, above) of a row with those of the next, [above, end), that they touch.
void OpenRuns::connect(std::size_t below, std::size_t above, std::size_t end, std::uint32_t width) {
  std::size_t low = below;
  for (std::size_t high = above; high < end; ++high) {
    // Where the run would be in the row below; at a corner they touch as well.
    const std::uint32_t first = runs_[high].first - width, last = runs_[high].end - width;
    while (low < above && runs_[low].end < first) ++low;
    for (std::size_t touching = low; touching < above && runs_[touching].first <= last; ++touching) {
      const std::uint32_t a = root_of(static_cast<std::uint32_t>(touching)),
                          b = root_of(static_cast<std::uint32_t>(high));
      root_[std::max(a, b)] = std::min(a, b);
    }
  }
}

std::uint32_t OpenRuns::run_of(std::uint32_t cell) const {
  const auto after = std::upper_bound(runs_.begin(), runs_.end(), cell,
                                      [](std::uint32_t c, const Run& run) { return c < run.first; });
  return static_cast<std::uint32_t>(after - runs_.begin()) - 1;
}

std::uint32_t OpenRuns::root_of(std::uint32_t run) {
  while (root_[run] != run) run = root_[run] = root_[root_[run]];
  return run;
}

}  // namespace topo::grid
