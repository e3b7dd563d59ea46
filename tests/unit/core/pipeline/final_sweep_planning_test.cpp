// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <utility>

#include "core/pipeline/planning_step.hpp"
#include "tests/unit/core/pipeline/toy_building.hpp"

namespace topo::pipeline {
namespace {

/// A room, and a chamber behind a gap of half a metre: nobody can drive in, and a glance in passing does not
/// show all of it.
std::vector<std::string> room_and_chamber() {
  std::vector<std::string> rows(20, "#" + std::string(24, ' ') + "#" + std::string(14, ' ') + "#");
  rows.insert(rows.begin(), std::string(41, '#'));
  rows.push_back(std::string(41, '#'));
  rows[4][2] = 'S';
  rows[10][25] = rows[11][25] = ' ';
  return rows;
}

struct SweepEnd {
  double known = 0.0;
  std::vector<types::Vector2> looked;  ///< what the robot tells its mates
};

/// Of an exploration of these by a robot whose mate, at home, has looked into some openings.
SweepEnd end_of_exploration(const PlannerParams& params, std::vector<types::Vector2> mate_looked = {}) {
  ToyBuilding building{room_and_chamber(), 5.0};
  PlanningState state(params);
  team::StatusMessage mate;
  mate.robot = 2;
  mate.duty = team::Duty::kOver;
  mate.T_map_base = {200.0, 0.0, 0.0};
  mate.looked = std::move(mate_looked);
  const TeamInput input{5, {&mate, 1}};
  building.hear(&input);
  PlanningOutput out;
  do {
    ++mate.sequence;
    out = building.run_period(state, {1, Order::kExplore, false, {0.0, 0.0}});
  } while (!out.report->mission_ended && building.now() < types::stamp_from_seconds(900.0));
  EXPECT_EQ(out.report->activity, Activity::kDone) << out.report->reason;
  return {building.coverage(), out.message.looked};
}

TEST(FinalSweep, ShowMoreOfAChamberThatNobodyCanDriveInto) {
  PlannerParams complete;
  PlannerParams without = complete;
  without.explore.final_sweep.promise_min = 1e9;
  const double with = end_of_exploration(complete).known, without_them = end_of_exploration(without).known;
  EXPECT_GT(with, without_them + 0.05);
  PlannerParams essential = complete;
  essential.explore.finish = Finish::kEssential;
  PlannerParams essential_without = essential;
  essential_without.explore.final_sweep.promise_min = 1e9;
  const SweepEnd end = end_of_exploration(essential);
  EXPECT_EQ(end.known, end_of_exploration(essential_without).known) << "whatever there would be to see";
  EXPECT_TRUE(end.looked.empty());
}

TEST(FinalSweep, OfARobotAreNoneForItsMates) {
  PlannerParams params;
  params.explore.final_sweep.promise_min = 0.04;  // the chamber's other corners alone do not promise so much
  const SweepEnd looks = end_of_exploration(params);
  ASSERT_FALSE(looks.looked.empty());
  const SweepEnd leaves = end_of_exploration(params, looks.looked);
  EXPECT_TRUE(leaves.looked.empty());
  EXPECT_LT(leaves.known, looks.known - 0.05);
}

}  // namespace
}  // namespace topo::pipeline
