// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/planning_memory.hpp"

#include <gtest/gtest.h>

#include "tests/unit/core/pipeline/toy_building.hpp"

namespace topo::pipeline {
namespace {

using exploration::Order;

/// A room of 10 by 3 m with a second one behind a door.
const std::vector<std::string> kRoomsWithADoor{
    "########################################", "#                   #                  #",
    "#                   #                  #", "#                   #                  #",
    "#  S                                   #", "#                                      #",
    "#                                      #", "#                   #                  #",
    "#                   #                  #", "########################################"};

/// A robot under way to its first goal, still far from it.
class UnderWay : public ::testing::Test {
 protected:
  UnderWay() {
    for (int i = 0; i < 4; ++i) out_ = building_.run_period(state_, mission_);
  }
  ToyBuilding building_{kRoomsWithADoor, 8.0};
  PlanningState state_{PlannerParams{}};
  Mission mission_{1, Order::kExplore, false, {0.0, 0.0}};
  PlanningOutput out_;
};

TEST_F(UnderWay, ALongPauseIsNotChargedToTheGoal) {
  ASSERT_TRUE(out_.report->goal);
  mission_.paused = true;
  for (int i = 0; i < 600; ++i) out_ = building_.run_period(state_, mission_);
  mission_.paused = false;
  for (int i = 0; i < 2; ++i) out_ = building_.run_period(state_, mission_);
  for (const exploration::DeferredGoal& deferred : out_.report->deferred)
    EXPECT_TRUE(deferred.visited) << "given up: " << deferred.why;
  EXPECT_TRUE(out_.report->goal);
}

TEST_F(UnderWay, AGoalThatWasGivenUpMovesWithTheMap) {
  building_.control().mode = ControlMode::kStuck;
  out_ = building_.run_period(state_, mission_);
  building_.control().mode = ControlMode::kStanding;
  ASSERT_EQ(out_.report->deferred.size(), 1U);
  const types::Vector2 was = out_.report->deferred.front().p_map;
  building_.bend(1.0);
  out_ = building_.run_period(state_, mission_);
  ASSERT_FALSE(out_.report->deferred.empty());
  EXPECT_LT((out_.report->deferred.front().p_map - was - types::Vector2(1.0, 0.0)).norm(), 0.05);
}

}  // namespace
}  // namespace topo::pipeline
