// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/configuration.hpp"

#include <gtest/gtest.h>

namespace topo::daemon {
namespace {

double route_disc_m(RobotModel model, double margin_m) {
  Configuration configuration;
  configuration.robot.model = model;
  configuration.motion.margin_m = margin_m;
  return planner_params(configuration).travel.radius_m;
}

TEST(Configuration, WhatIsConfiguredOfPlausibilityReachesControl) {
  Configuration configuration;
  configuration.plausibility.picture.open_space = true;
  configuration.plausibility.strikes = 5;
  const pipeline::ControlParams params = control_params(configuration);
  EXPECT_TRUE(params.plausibility.picture.open_space);
  EXPECT_EQ(params.plausibility.strikes, 5);
}

TEST(Configuration, RoutesHaveRoomToTurnOnTheSpot) {
  EXPECT_DOUBLE_EQ(route_disc_m(RobotModel::kP3dx, 0.05), 0.267 + 0.03);
  EXPECT_DOUBLE_EQ(route_disc_m(RobotModel::kP3dx, 0.02), 0.267 + 0.02);
  EXPECT_DOUBLE_EQ(route_disc_m(RobotModel::kP3at, 0.05), 0.340 + 0.03);
}

TEST(Configuration, StraightThroughADoorLessClearanceIsEnough) {
  Configuration configuration;
  configuration.robot.model = RobotModel::kP3dx;
  configuration.motion.margin_m = 0.05;
  const auto travel = [&] { return planner_params(configuration).travel; };
  EXPECT_NEAR(travel().tight_m, footprint(configuration).half_width_m + 0.05 - 0.005, 1e-12);
  EXPECT_LT(travel().tight_m, travel().radius_m);
  configuration.motion.margin_m = 0.5;
  EXPECT_LE(travel().tight_m, travel().radius_m) << "never more than to turn in";
  configuration.motion.passage_radius_m = 0.4;
  EXPECT_EQ(travel().tight_m, 0.4);
  EXPECT_EQ(travel().radius_m, 0.4);
}

TEST(Configuration, ARobotOnItsWayHomeRollsOnAsItsBrakesSay) {
  Configuration configuration;
  configuration.base.deceleration_mps2 = 0.3;
  EXPECT_EQ(planner_params(configuration).explore.homing.brakes_mps2, 0.3);
}

// Else the planner sends the robot where the gate holds it back.
TEST(Configuration, RoutesHaveRoomForTheMarginThatIsKept) {
  for (const RobotModel model : {RobotModel::kP3dx, RobotModel::kP3at}) {
    for (const double margin_m : {0.05, 0.1, 0.2, 0.5}) {
      Configuration configuration;
      configuration.robot.model = model;
      EXPECT_GE(route_disc_m(model, margin_m), footprint(configuration).half_width_m + margin_m) << margin_m;
    }
  }
}

}  // namespace
}  // namespace topo::daemon
