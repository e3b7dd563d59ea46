// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/goals/goal_stages.hpp"

#include <algorithm>

#include "core/goals/frontiers.hpp"

namespace topo::bench {
namespace {

double free_m2_of(const grid::DenseMap& map) {
  const auto free = std::count(map.cells.begin(), map.cells.end(), grid::CellState::kFree);
  return static_cast<double>(free) * map.resolution_m * map.resolution_m;
}

}  // namespace

void GoalStages::planned(const pipeline::PlanningOutput& output) {
  const std::shared_ptr<const analysis::Analysis>& analysis = output.report->analysis;
  if (analysis == nullptr || analysis.get() == last_ || next_ == count_) return;
  last_ = analysis.get();
  const double known = free_m2_of(analysis->map) / free_m2_;
  const auto is_due = [&] { return next_ < count_ && known * count_ >= next_ + 0.5; };
  if (!is_due()) return;
  while (is_due()) ++next_;  // a look into a hall may pass several at once
  stages_.push_back({types::to_seconds(output.report->stamp), known,
                     goals::find_frontiers(analysis->map).size(), analysis->goals.goals.size(),
                     openings_onto_space(*analysis, truth_, T_building_map_), analysis});
}

}  // namespace topo::bench
