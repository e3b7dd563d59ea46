// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/perception/steady_frame.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

namespace topo::perception {
namespace {

using types::Odometry;
using types::Se2;

using MapOdom = types::Transform2<types::Map, types::Odom>;

Odometry at(const Se2& T_odom_base) {
  Odometry odometry;
  odometry.T_odom_base = types::Transform2<types::Odom, types::Base>(T_odom_base);
  return odometry;
}

void expect_near(const Se2& a, const Se2& b, double within) {
  EXPECT_NEAR(a.x_m, b.x_m, within);
  EXPECT_NEAR(a.y_m, b.y_m, within);
  EXPECT_NEAR(types::wrap_angle(a.theta_rad - b.theta_rad), 0.0, within);
}

TEST(SteadyFrame, FollowsTheDriftOfARobotThatTurnsAbout) {
  SteadyFrame frame;
  const Se2 start{30.0, -20.0, 0.4};
  const double true_share = 0.95;  // of what the wheels say, as with a track that is told too wide
  Se2 T_map_base = start, T_odom_base;
  for (int k = 0; k < 60; ++k) {
    frame.update(MapOdom(T_map_base * T_odom_base.inverse()), 0, at(T_odom_base));
    const double turn_rad = k < 40 ? 0.3 : -0.3;
    T_map_base = T_map_base * Se2{0.01, 0.0, true_share * turn_rad};
    T_odom_base = T_odom_base * Se2{0.01, 0.0, turn_rad};
  }
  const Se2 moved = start.inverse() * T_map_base;
  expect_near(frame.steady(at(T_odom_base)).T_odom_base.se2(), moved, 0.02);
  EXPECT_GT(std::abs(types::wrap_angle(T_odom_base.theta_rad - moved.theta_rad)), 0.25) << "odometry alone";
}

/// From one word of the mapper to the next the wheels report `rolled` and the robot goes `gone`.
void expect_followed(const Se2& rolled, const Se2& gone) {
  SteadyFrame frame;
  const Se2 start{5.0, -3.0, 0.7};
  frame.update(MapOdom(start), 0, at({}));
  frame.update(MapOdom(start * gone * rolled.inverse()), 0, at(rolled));
  expect_near(frame.steady(at(rolled)).T_odom_base.se2(), gone, 1e-9);
}

TEST(SteadyFrame, FollowsASlipOnTheSpotAndUnderWay) {
  // A wheel in vain for a part of a turn carries the middle of the robot off ...
  expect_followed({0.0, 0.0, 0.986}, {-0.027, 0.029, 0.849});
  // ... and turns a robot that drives straight on.
  expect_followed({0.392, 0.0, 0.005}, {0.366, 0.040, 0.210});
  // As much as a robot has to expect: 0.6 of a wheel's way, or of both.
  expect_followed({0.28, 0.0, 0.0}, {0.19, 0.04, 0.46});
  expect_followed({0.28, 0.0, 0.0}, {0.112, 0.0, 0.0});
  expect_followed({0.0, 0.0, 0.5}, {-0.02, 0.02, 0.35});
}

TEST(SteadyFrame, NothingElseIsDriftHoweverFarTheRobotDrove) {
  const Se2 rolled{0.28, 0.0, 0.0};
  const auto steady_after = [&](const Se2& T_map_odom, std::uint32_t bends) {
    SteadyFrame frame;
    frame.update(MapOdom(Se2{}), 0, at({}));
    frame.update(MapOdom(T_map_odom), bends, at(rolled));
    return frame.steady(at(rolled)).T_odom_base.se2();
  };
  const Se2 closure{0.06, 0.0, 0.08};
  expect_near(steady_after(closure, 1), rolled, 1e-12);
  expect_near(steady_after(closure, 0), closure * rolled, 1e-9);
  expect_near(steady_after({0.4, 0.0, 0.0}, 0), rolled, 1e-12);
  expect_near(steady_after({0.0, 0.0, 0.8}, 0), rolled, 1e-12);
}

TEST(SteadyFrame, ALoopClosureMovesTheRobotAndItsSurroundingsTogether) {
  SteadyFrame frame;
  const Odometry odometry = at({12.0, 3.0, 1.0});
  frame.update(MapOdom(0.0, 0.0, 0.0), 0, odometry);
  frame.update(MapOdom(0.3, -0.1, 0.02), 0, odometry);
  expect_near(frame.steady(odometry).T_odom_base.se2(), odometry.T_odom_base.se2(), 1e-12);
  // Far from odom's origin a small turn of it is a closure as well.
  frame.update(MapOdom(0.3, -0.1, 0.04), 0, odometry);
  expect_near(frame.steady(odometry).T_odom_base.se2(), odometry.T_odom_base.se2(), 1e-12);
}

TEST(SteadyFrame, AMatcherThatSlidesUnderARobotThatStandsIsNotFollowed) {
  SteadyFrame frame;
  const Odometry odometry = at({12.0, 3.0, 1.0});
  for (int k = 0; k < 20; ++k) frame.update(MapOdom(0.03 * k, 0.0, 0.0), 0, odometry);
  expect_near(frame.steady(odometry).T_odom_base.se2(), odometry.T_odom_base.se2(), 1e-12);
}

TEST(SteadyFrame, WhatWasMissedIsNotFollowed) {
  SteadyFrame frame;
  const Odometry odometry = at({1.0, 0.0, 0.0});
  frame.update(MapOdom(0.0, 0.0, 0.0), 0, odometry);
  frame.lose();
  frame.update(MapOdom(0.05, 0.0, 0.05), 0, odometry);
  expect_near(frame.steady(odometry).T_odom_base.se2(), odometry.T_odom_base.se2(), 1e-12);
  frame.update(MapOdom(0.06, 0.0, 0.05), 0, odometry);
  EXPECT_NEAR(frame.steady(odometry).T_odom_base.x_m(), 1.01, 1e-4) << "and from then on it is";
}

/// The robot's own frame is all that counts.
TEST(SteadyFrame, IsTheSameInWhateverFrameTheMapIs) {
  EXPECT_TRUE(rc::check([] {
    const auto any = [](int most) { return 0.001 * *rc::gen::inRange(-most, most + 1); };
    const Se2 map_frame{any(20000), any(20000), any(3141)};
    SteadyFrame here, there;
    Se2 T_map_base, T_odom_base;
    for (int k = *rc::gen::inRange(1, 20); k > 0; --k) {
      const std::uint32_t bends = *rc::gen::inRange(0, 10) == 0 ? 1 : 0;
      if (*rc::gen::inRange(0, 8) == 0) {
        here.lose();
        there.lose();
      }
      const Se2 T_map_odom = T_map_base * T_odom_base.inverse();
      here.update(MapOdom(T_map_odom), bends, at(T_odom_base));
      there.update(MapOdom(map_frame * T_map_odom), bends, at(T_odom_base));
      expect_near(here.steady(at(T_odom_base)).T_odom_base.se2(),
                  there.steady(at(T_odom_base)).T_odom_base.se2(), 1e-6);
      const Se2 rolled{any(200), 0.0, any(400)};
      T_odom_base = T_odom_base * rolled;
      T_map_base = T_map_base * rolled * Se2{any(15), any(15), any(15)};
    }
    RC_ASSERT(!::testing::Test::HasFailure());
  }));
}

TEST(SteadyFrame, ChangesThePoseAloneAndNothingAtFirst) {
  const SteadyFrame frame;
  Odometry odometry = at({1.0, 2.0, 0.5});
  odometry.stamp = types::stamp_from_seconds(7.0);
  odometry.twist = {0.3, -0.2};
  const Odometry steady = frame.steady(odometry);
  EXPECT_EQ(steady.T_odom_base, odometry.T_odom_base);
  EXPECT_EQ(steady.stamp, odometry.stamp);
  EXPECT_EQ(steady.twist, odometry.twist);
}

}  // namespace
}  // namespace topo::perception
