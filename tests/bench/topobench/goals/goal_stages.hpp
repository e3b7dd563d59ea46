// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "tests/bench/topobench/explore/explore_run.hpp"
#include "tests/bench/topobench/goals/openings_onto_space.hpp"

namespace topo::bench {

/// One partial map of an exploration and what the analysis made of it.
struct GoalStage {
  double t_s = 0.0;
  double known = 0.0;  ///< free area, as a share of the building's
  std::size_t clusters = 0, goals = 0;
  OpeningsOntoSpace onto_space;
  std::shared_ptr<const analysis::Analysis> analysis;
};

/// Looks on at an exploration and takes the analysis at `count` stages: the first map of which (k + 0.5) /
/// `count` of the free area is known, k from 0. The robot never learns of it.
class GoalStages final : public RunHooks {
 public:
  GoalStages(DrivableTruth truth, const types::Se2& T_building_map, double free_m2, int count)
      : truth_(std::move(truth)), T_building_map_(T_building_map), free_m2_(free_m2), count_(count) {}

  void planned(const pipeline::PlanningOutput& output) override;

  [[nodiscard]] const std::vector<GoalStage>& stages() const { return stages_; }

 private:
  DrivableTruth truth_;
  types::Se2 T_building_map_;
  double free_m2_;
  int count_, next_ = 0;
  const analysis::Analysis* last_ = nullptr;
  std::vector<GoalStage> stages_;
};

}  // namespace topo::bench
