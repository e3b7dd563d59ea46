// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/plan.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "core/pipeline/planning_report.hpp"

namespace topo::pipeline {
namespace {

using types::Vector2;

TEST(PutPath, isInOdomAndSaysWhetherItIsTheWholeWay) {
  std::vector<Vector2> path;
  for (int i = 0; i < 10; ++i) path.emplace_back(0.1 * i, 0.0);
  const types::Transform2<types::Map, types::Odom> T_map_odom(1.0, 2.0, 1.5707963267948966);
  Plan plan;
  put_path(path, T_map_odom, plan);
  ASSERT_EQ(plan.points, 10);
  EXPECT_TRUE(plan.path_ends_at_goal);
  for (std::size_t i = 0; i < path.size(); ++i)
    EXPECT_LT((T_map_odom.se2() * plan.path_odom[i] - path[i]).norm(), 1e-9);
  path.resize(1000, Vector2(1.0, 0.0));
  put_path(path, T_map_odom, plan);
  EXPECT_EQ(plan.points, Plan::kMaxPoints);
  EXPECT_FALSE(plan.path_ends_at_goal);
  put_path({}, T_map_odom, plan);
  EXPECT_EQ(plan.points, 0);
}

TEST(MakePlan, ATurnIsInOdomAndDoesNotBackOffIntoAMate) {
  PlanningInput in;
  in.now = types::stamp_from_seconds(100.0);
  exploration::Intent intent;
  intent.phase = exploration::Exploring{};
  intent.pursuit = exploration::turning_to(3.0, {}, in.now);
  Whereabouts place;
  place.T_map_odom = types::Transform2<types::Map, types::Odom>(1.0, 2.0, -1.0);
  team::Roster roster;
  const auto plan = [&] { return make_plan(1, in, intent, place, {}, {5, roster, {}}, {}); };
  EXPECT_TRUE(plan().moving);
  ASSERT_TRUE(plan().turn_to_rad);
  EXPECT_NEAR(*plan().turn_to_rad, 4.0 - 2.0 * std::numbers::pi, 1e-9);
  EXPECT_FALSE(plan().mate_behind);
  team::StatusMessage mate;
  mate.robot = 2;
  mate.sequence = 1;
  mate.T_map_base = {-1.0, 0.0, 0.0};
  ASSERT_TRUE(roster.take(mate, in.now));
  EXPECT_TRUE(plan().mate_behind);
  intent.phase = exploration::Paused{exploration::Exploring{}};
  EXPECT_FALSE(plan().moving);
}

TEST(MakePlan, ARobotThatCannotPlanStands) {
  PlanningInput in;
  in.now = types::stamp_from_seconds(100.0);
  exploration::Intent turning, going;
  turning.phase = going.phase = exploration::Exploring{};
  turning.pursuit = exploration::turning_to(3.0, {}, in.now);
  going.pursuit.has_target = true;
  const std::vector<Vector2> route{{0.0, 0.0}, {1.0, 0.0}};
  team::Roster roster;
  Whereabouts place;
  for (const exploration::Intent& intent : {turning, going}) {
    const auto plan = [&] { return make_plan(1, in, intent, place, route, {5, roster, {}}, {}); };
    place.missing = {};
    EXPECT_TRUE(plan().moving);
    for (const char* why : {"lost", "e-stop"}) {
      place.missing = why;
      EXPECT_FALSE(plan().moving);
      EXPECT_FALSE(plan().turn_to_rad);
      EXPECT_EQ(plan().points, 0);
    }
  }
}

}  // namespace
}  // namespace topo::pipeline
