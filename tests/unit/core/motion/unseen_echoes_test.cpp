// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/motion/unseen_echoes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace topo::motion {
namespace {

using types::Vector2;

/// A robot with one sonar straight ahead and one to the left, a laser of 270 degrees that sees everything at
/// one range.
struct Robot {
  explicit Robot(float laser_range_m) {
    scan.beams = 1081;
    scan.geometry.angle_min_rad = -2.3562F;
    scan.geometry.angle_increment_rad = 0.0043633F;
    scan.range_m.fill(laser_range_m);
    around.front_scan = &scan;
    around.now = types::stamp_from_seconds(10.0);
    around.sonar = sonar;
    around.T_base_sonar = T_base_sonar;
    for (auto& echo : sonar) echo = {around.now - std::chrono::milliseconds(50), 5.0F};
  }
  std::size_t count() { return unseen_echoes(around, 1.5, out); }
  types::Scan scan;
  std::array<types::SonarReading, 2> sonar;
  std::array<types::Se2, 2> T_base_sonar{types::Se2{0.17, 0.0, 0.0}, types::Se2{0.07, 0.136, 1.5708}};
  Surroundings around;
  std::array<Vector2, 8> out;
};

TEST(UnseenEchoes, whatTheLaserDoesNotSeeIsReported) {
  Robot robot(4.0F);
  EXPECT_EQ(robot.count(), 0U);
  robot.sonar[0].range_m = 0.8F;
  ASSERT_EQ(robot.count(), 1U);
  EXPECT_NEAR(robot.out[0].x(), 0.97, 1e-6);
  EXPECT_NEAR(robot.out[0].y(), 0.0, 1e-6);
  robot.sonar[1].range_m = 0.6F;
  ASSERT_EQ(robot.count(), 2U);
  EXPECT_NEAR(robot.out[1].y(), 0.736, 1e-4);
}

TEST(UnseenEchoes, whatTheLaserSeesIsNot) {
  Robot robot(0.9F);
  robot.sonar[0].range_m = 0.75F;
  EXPECT_EQ(robot.count(), 0U);
  // Something in front of the echo, only a hand wide.
  robot = Robot(4.0F);
  robot.around.front_scan = &robot.scan;
  robot.around.sonar = robot.sonar;
  robot.around.T_base_sonar = robot.T_base_sonar;
  robot.sonar[0].range_m = 0.75F;
  for (std::size_t i = 560; i < 580; ++i) robot.scan.range_m[i] = 0.9F;
  EXPECT_EQ(robot.count(), 0U);
}

TEST(UnseenEchoes, oldFarAndRearEchoesSayNothing) {
  Robot robot(4.0F);
  robot.sonar[0] = {robot.around.now - std::chrono::milliseconds(400), 0.8F};
  EXPECT_EQ(robot.count(), 0U);
  robot.sonar[0] = {robot.around.now, 1.6F};
  EXPECT_EQ(robot.count(), 0U);
  robot.sonar[0] = {types::Stamp{}, 0.8F};
  EXPECT_EQ(robot.count(), 0U);
  robot.sonar[0] = {robot.around.now, 0.8F};
  robot.T_base_sonar[0].theta_rad = 3.0;
  EXPECT_EQ(robot.count(), 0U);
  robot.around.front_scan = nullptr;
  EXPECT_EQ(robot.count(), 0U);
}

}  // namespace
}  // namespace topo::motion
