// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/motion/breadcrumb_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/unit/core/motion/generators.hpp"

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
  EXPECT_NEAR(trail.turn_to_back_rad(), 0.0, BreadcrumbParams{}.behind_rad);
  const types::Twist2 back = trail.back_twist(0.1);
  EXPECT_EQ(back.v_mps, -0.1);
  EXPECT_LT(std::abs(back.omega_radps), 0.05);
  for (double y = 0.12; y >= 0.01; y -= 0.01) trail.update({0.0, y, 1.5708});
  EXPECT_EQ(trail.back_twist(0.1), types::Twist2{}) << "from the corner on it lies aside";
  EXPECT_NEAR(trail.turn_to_back_rad(), -1.5708, 0.15);
  EXPECT_LT(trail.behind_m(), 0.05);
}

/// A drive with stops, turns and short ways back.
std::vector<types::Se2> any_drive() {
  std::vector<types::Se2> poses;
  types::Se2 pose;
  for (int legs = *rc::gen::inRange(1, 6); legs > 0; --legs) {
    const double step_m = *rc::gen::element(0.01, 0.017, 0.03, -0.01, 0.0), turn_rad = uniform(-0.05, 0.05);
    for (int steps = *rc::gen::inRange(1, 60); steps > 0; --steps)
      poses.push_back(pose = pose * types::Se2{step_m, 0.0, turn_rad});
  }
  return poses;
}

TEST(BreadcrumbPath, IsNoLongerThanTheWayAndAMetre) {
  EXPECT_TRUE(rc::check([] {
    BreadcrumbPath trail;
    double driven_m = 0.0;
    bool went_back = false;  // beside the trail the way to its end counts as well
    types::Se2 last;
    for (const types::Se2& pose : any_drive()) {
      driven_m += types::distance_m(last, pose);
      went_back = went_back || (last.inverse() * pose).x_m < 0.0;
      last = pose;
      trail.update(pose);
      RC_ASSERT(trail.length_m() <= driven_m + 1e-9);
      // The oldest point is up to two steps of a drive farther than that.
      if (!went_back) RC_ASSERT(trail.length_m() <= BreadcrumbParams{}.length_m + 0.07);
      RC_ASSERT(trail.behind_m() <= trail.length_m() + 1e-9);
      RC_ASSERT(trail.behind_m() >= 0.0);
      const types::Twist2 back = trail.back_twist(0.07);
      RC_ASSERT((back.v_mps == -0.07 || back == types::Twist2{}));
      if (back.v_mps != 0.0) RC_ASSERT(std::abs(trail.turn_to_back_rad()) <= BreadcrumbParams{}.behind_rad);
    }
    trail.clear();
    RC_ASSERT(trail.length_m() == 0.0);
    RC_ASSERT(trail.behind_m() == 0.0);
    RC_ASSERT(trail.turn_to_back_rad() == 0.0);
    RC_ASSERT(trail.back_twist(0.1) == types::Twist2{});
  }));
}

TEST(BreadcrumbPath, MirroredLeadsBackTheMirroredWay) {
  EXPECT_TRUE(rc::check([] {
    BreadcrumbPath left, right;
    for (const types::Se2& pose : any_drive()) {
      left.update(pose);
      right.update({pose.x_m, -pose.y_m, -pose.theta_rad});
      const types::Twist2 a = left.back_twist(0.1), b = right.back_twist(0.1);
      RC_ASSERT(a.v_mps == b.v_mps);
      // To the last bit: a comparison with a threshold must not come out otherwise on the other side.
      RC_ASSERT(a.omega_radps == -b.omega_radps);
      RC_ASSERT(types::wrap_angle(left.turn_to_back_rad() + right.turn_to_back_rad()) == 0.0);
      RC_ASSERT(left.behind_m() == right.behind_m());
      RC_ASSERT(left.length_m() == right.length_m());
    }
  }));
}

TEST(BreadcrumbPath, LeadsBackOverGroundThatTheRobotCovered) {
  EXPECT_TRUE(rc::check([] {
    const double curvature = uniform(-1.0, 1.0);
    BreadcrumbPath trail;
    std::vector<types::Vector2> way;
    types::Se2 pose;
    for (int i = 0; i < 80; ++i) {
      trail.update(pose = pose * types::Se2{0.01, 0.0, 0.01 * curvature});
      way.push_back(pose.translation());
    }
    int steps = 0;
    for (; steps < 200; ++steps) {
      const types::Twist2 back = trail.back_twist(0.1);
      if (back == types::Twist2{}) break;
      pose = pose * types::Se2{back.v_mps * 0.05, 0.0, back.omega_radps * 0.05};
      trail.update(pose);
      double off_m = HUGE_VAL;
      for (const types::Vector2& p : way) off_m = std::min(off_m, (p - pose.translation()).norm());
      RC_ASSERT(off_m < 0.03);
    }
    RC_ASSERT(steps < 200);
    RC_ASSERT(pose.translation().norm() < 0.15);
  }));
}

}  // namespace
}  // namespace topo::motion
