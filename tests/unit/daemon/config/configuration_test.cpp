// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/configuration.hpp"

#include <gtest/gtest.h>

namespace topo::daemon {
namespace {

double route_radius_m(double margin_m, double passage_radius_m = 0.0) {
  Configuration configuration;
  configuration.motion.margin_m = margin_m;
  configuration.motion.passage_radius_m = passage_radius_m;
  return planner_params(configuration).travel.radius_m;
}

TEST(PlannerParams, RoutesKeepWhatTurningOnTheSpotNeedsAndGoingStraightOn) {
  const motion::Footprint hull = footprint(Configuration{});
  const double turning_m = motion::reach_m(hull) + motion::RobotLimits{}.turn_margin_m;
  EXPECT_DOUBLE_EQ(route_radius_m(0.05), turning_m) << "the margin of straight ways is not for turning";
  EXPECT_LT(turning_m + 0.025, 0.75 / 2.0 - 0.025)
      << "doors of 0.75 m, each jamb drawn half a cell too far out";
  EXPECT_DOUBLE_EQ(route_radius_m(0.3), hull.half_width_m + 0.3)
      << "a wide margin is for straight ways as well";
  EXPECT_DOUBLE_EQ(route_radius_m(0.3, 0.4), 0.4) << "as told";
}

}  // namespace
}  // namespace topo::daemon
