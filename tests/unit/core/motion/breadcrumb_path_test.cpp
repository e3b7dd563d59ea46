// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/motion/breadcrumb_path.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace topo::motion {
namespace {

TEST(BreadcrumbPath, IsTheLastMetreAndIsUsedUpBackwards) {
  BreadcrumbPath trail;
  EXPECT_EQ(trail.back_twist(0.1), types::Twist2{});
  for (double x = 0.0; x <= 3.0; x += 0.01) trail.update({x, 0.0, 0.0});
  EXPECT_NEAR(trail.length_m(), 1.0, 0.05);
  for (double x = 3.0; x >= 2.5; x -= 0.01) trail.update({x, 0.0, 0.0});
  EXPECT_NEAR(trail.length_m(), 0.5, 0.06);
  EXPECT_NEAR(trail.behind_m(), 0.5, 0.06);
  for (double x = 2.5; x >= 1.8; x -= 0.01) trail.update({x, 0.0, 0.0});
  EXPECT_EQ(trail.back_twist(0.1), types::Twist2{}) << "behind its end nothing is known";
}

TEST(BreadcrumbPath, LeadsBackAlongACurve) {
  BreadcrumbPath trail;
  types::Se2 pose;
  for (int i = 0; i < 100; ++i) trail.update(pose = pose * types::Se2{0.01, 0.0, 0.01});
  const types::Se2 end = pose;
  for (int i = 0; i < 50; ++i) {
    const types::Twist2 back = trail.back_twist(0.1);
    ASSERT_LT(back.v_mps, 0.0);
    pose = pose * types::Se2{back.v_mps * 0.1, 0.0, back.omega_radps * 0.1};
    trail.update(pose);
  }
  EXPECT_NEAR((pose.translation() - end.translation()).norm(), 0.5, 0.03);
  // On the circle of radius 1 m round (0, 1) that it came on.
  EXPECT_NEAR((pose.translation() - types::Vector2{0.0, 1.0}).norm(), 1.0, 0.03);
}

TEST(BreadcrumbPath, IsNoWayBackWhenTheRobotHasTurnedOrJumped) {
  BreadcrumbPath trail;
  for (double x = 0.0; x <= 1.0; x += 0.01) trail.update({x, 0.0, 0.0});
  trail.update({1.0, 0.0, 1.5});
  EXPECT_EQ(trail.back_twist(0.1), types::Twist2{});
  EXPECT_NEAR(trail.turn_to_back_rad(), -1.5, 0.05);
  trail.update({5.0, 0.0, 0.0});
  EXPECT_LT(trail.length_m(), 0.01);
}

/// Between shelves it turned on the spot and went on a hand's breadth: that much is straight behind it.
TEST(BreadcrumbPath, LeadsBackToTheCornerWhereTheRobotTurnedOnTheSpot) {
  BreadcrumbPath trail;
  for (double x = -1.0; x <= 0.0; x += 0.01) trail.update({x, 0.0, 0.0});
  for (double y = 0.0; y <= 0.12; y += 0.01) trail.update({0.0, y, 1.5708});
  EXPECT_NEAR(trail.behind_m(), 0.12, 0.01);
  EXPECT_NEAR(trail.turn_to_back_rad(), 0.0, BreadcrumbPath::kBehind_rad);
  const types::Twist2 back = trail.back_twist(0.1);
  EXPECT_EQ(back.v_mps, -0.1);
  EXPECT_LT(std::abs(back.omega_radps), 0.05);
  for (double y = 0.12; y >= 0.01; y -= 0.01) trail.update({0.0, y, 1.5708});
  EXPECT_EQ(trail.back_twist(0.1), types::Twist2{}) << "from the corner on it lies aside";
  EXPECT_NEAR(trail.turn_to_back_rad(), -1.5708, 0.15);
  EXPECT_LT(trail.behind_m(), 0.05);
}

}  // namespace
}  // namespace topo::motion
