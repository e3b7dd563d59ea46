// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/analyse/timed_analysis.hpp"

#include <algorithm>
#include <chrono>

#include "core/grid/distance.hpp"

namespace topo::bench {
namespace {

using Clock = std::chrono::steady_clock;

double ms_between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double, std::milli>(to - from).count();
}

}  // namespace

TimedAnalysis timed_analysis(const grid::DenseMap& map, int repeat, const analysis::AnalysisParams& params) {
  TimedAnalysis timed;
  for (int run = 0; run < std::max(repeat, 1); ++run) {
    // A picture has no height columns and nobody was anywhere.
    analysis::AnalysisInput input{1, map, {}, {}, {}};
    const Clock::time_point start = Clock::now();
    Clock::time_point before = start;
    const auto note = [&](std::size_t stage) {
      const Clock::time_point now = Clock::now();
      timed.ms[stage].push_back(ms_between(before, now));
      before = now;
    };
    const std::vector<float> clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
    input.clearance_m = clearance_m;
    note(0);
    timed.analysis = analysis::analyse(
        std::move(input), params, [&](analysis::Stage stage) { note(1 + static_cast<std::size_t>(stage)); });
    timed.ms.back().push_back(ms_between(start, before));
  }
  for (auto& of_stage : timed.ms) std::sort(of_stage.begin(), of_stage.end());
  return timed;
}

double one_pass_ms(const grid::DenseMap& map) {
  double best = HUGE_VAL;
  for (int run = 0; run < 9; ++run) {
    const auto start = Clock::now();
    const volatile auto free = std::count(map.cells.begin(), map.cells.end(), grid::CellState::kFree);
    (void)free;
    best = std::min(best, ms_between(start, Clock::now()));
  }
  return best;
}

}  // namespace topo::bench
