// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/calibrated_reckoning.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace topo::bench {
namespace {

constexpr double kCycle_s = 0.1;

/// In whole millimetres and 4096 headings, as a firmware tells.
types::Odometry told(double t_s, const types::Se2& pose, const types::Twist2& twist) {
  const double unit_rad = 2.0 * std::numbers::pi / 4096.0;
  const types::Se2 whole{std::trunc(1e3 * pose.x_m) * 1e-3, std::trunc(1e3 * pose.y_m) * 1e-3,
                         types::wrap_angle(std::trunc(pose.theta_rad / unit_rad) * unit_rad)};
  return {types::stamp_from_seconds(t_s), types::Transform2<types::Odom, types::Base>(whole), twist};
}

TEST(CalibratedReckoning, WithTheModelsWheelsItPassesOn) {
  CalibratedReckoning reckoning({});
  const types::Odometry counted = told(1.0, {40.123, -3.0, 2.0}, {0.3, 0.1});
  const types::Odometry out = reckoning.update(counted);
  EXPECT_EQ(out.stamp, counted.stamp);
  EXPECT_EQ(out.T_odom_base.se2().x_m, counted.T_odom_base.se2().x_m);
  EXPECT_EQ(out.twist.v_mps, counted.twist.v_mps);
}

/// Around for longer than the counters last.
TEST(CalibratedReckoning, AStraightWayOfTheFirmwareIsAnArcOfTheRobot) {
  const types::WheelCalibration wheels{0.99, 1.01, 0.36};
  CalibratedReckoning reckoning(wheels);
  const double v_mps = 0.5, seconds = 80.0;
  types::Odometry out;
  for (int i = 0; i * kCycle_s <= seconds; ++i)
    out = reckoning.update(told(i * kCycle_s, {v_mps * i * kCycle_s, 0.0, 0.0}, {v_mps, 0.0}));
  const double turn_radps = (wheels.right - wheels.left) * v_mps / wheels.track_m;
  EXPECT_NEAR(out.twist.v_mps, v_mps, 1e-9);
  EXPECT_NEAR(out.twist.omega_radps, turn_radps, 1e-9);
  const double turned_rad = turn_radps * seconds, radius_m = v_mps / turn_radps;
  const types::Se2 pose = out.T_odom_base.se2();
  EXPECT_NEAR(pose.x_m, radius_m * std::sin(turned_rad), 0.02);
  EXPECT_NEAR(pose.y_m, radius_m * (1.0 - std::cos(turned_rad)), 0.02);
  EXPECT_NEAR(types::wrap_angle(pose.theta_rad - turned_rad), 0.0, 0.002);
}

}  // namespace
}  // namespace topo::bench
