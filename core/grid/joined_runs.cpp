// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/grid/joined_runs.hpp"

#include <algorithm>
#include <cstring>

namespace topo::grid {

void JoinedRuns::clear(std::size_t width) {
  width_ = static_cast<std::uint32_t>(width);
  runs_.clear();
  root_.clear();
  row_ = in_row_ = beside_ = 0;
}

void JoinedRuns::add(CellRun run) {
  const std::uint32_t number = size(), row = run.first / width_;
  if (row != row_) {
    beside_ = row == row_ + 1 ? in_row_ : number;
    in_row_ = number;
    row_ = row;
  }
  runs_.push_back(run);
  root_.push_back(number);
  if (beside_ == in_row_) return;
  // The run shifted to the row below; runs that meet at a corner are connected as well.
  const std::uint32_t first = run.first - width_, last = run.end - width_;
  while (beside_ < in_row_ && runs_[beside_].end < first) ++beside_;
  for (std::uint32_t touching = beside_; touching < in_row_ && runs_[touching].first <= last; ++touching) {
    const std::uint32_t a = root_of(touching), b = root_of(number);
    root_[std::max(a, b)] = std::min(a, b);
  }
}

void JoinedRuns::add_marked(std::size_t first, std::span<const std::uint8_t> marks) {
  const auto next = [&](std::size_t from, int mark) {
    const void* const found = std::memchr(marks.data() + from, mark, marks.size() - from);
    return found == nullptr
               ? marks.size()
               : static_cast<std::size_t>(static_cast<const std::uint8_t*>(found) - marks.data());
  };
  for (std::size_t at = 0; (at = next(at, 1)) < marks.size();) {
    const std::size_t begin = at;
    at = next(at, 0);
    add({static_cast<std::uint32_t>(first + begin), static_cast<std::uint32_t>(first + at)});
  }
}

std::uint32_t JoinedRuns::root_of(std::uint32_t run) {
  while (root_[run] != run) run = root_[run] = root_[root_[run]];
  return run;
}

std::uint32_t JoinedRuns::run_of(std::uint32_t cell) const {
  const auto after = std::upper_bound(runs_.begin(), runs_.end(), cell,
                                      [](std::uint32_t c, const CellRun& run) { return c < run.first; });
  return static_cast<std::uint32_t>(after - runs_.begin()) - 1;
}

std::vector<JoinedRuns::Extent> JoinedRuns::extents() {
  std::vector<Extent> all;
  all.reserve(runs_.size());
  for (std::uint32_t number = 0; number < size(); ++number) {
    const std::uint32_t row = runs_[number].first / width_;
    const std::uint32_t left = runs_[number].first - row * width_, right = runs_[number].end - row * width_;
    all.push_back({left, right, row, row});
    Extent& e = all[root_of(number)];
    e = {std::min(e.left, left), std::max(e.right, right), std::min(e.low, row), std::max(e.high, row)};
  }
  return all;
}

}  // namespace topo::grid
