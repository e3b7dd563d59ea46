// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/motion/path_follower.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <vector>

namespace topo::motion {
namespace {

using types::Se2;
using types::Twist2;
using types::Vector2;

/// A robot that does at once what it is told.
struct Course {
  types::RobotLimits limits;
  std::vector<Vector2> path;
  std::vector<Vector2> obstacles;  ///< in odom
  Se2 pose;
  PathFollower follower;
  FollowOutput out;
  double furthest_off_m = 0.0;

  void step() {
    std::vector<Vector2> seen;
    for (const Vector2& p : obstacles) seen.push_back(pose.inverse() * p);
    FollowInput in;
    in.T_odom_base = pose;
    in.twist = out.twist;
    in.path_odom = path;
    in.path_number = 1;
    in.ends_at_goal = true;
    in.obstacles_base = seen;
    in.blind_s = 2.15;
    in.alive_s = 0.2;
    in.limits = &limits;
    out = follower.step(in);
    const double turn = out.twist.omega_radps * 0.05, way = out.twist.v_mps * 0.05;
    pose = pose * Se2{way * std::cos(0.5 * turn), way * std::sin(0.5 * turn), turn};
    double off_m = HUGE_VAL;
    for (const Vector2& p : path) off_m = std::min(off_m, (p - pose.translation()).norm());
    furthest_off_m = std::max(furthest_off_m, off_m);
  }
  /// Seconds until the end of the path.
  double run(double limit_s = 60.0) {
    double t = 0.0;
    for (; t < limit_s && !out.arrived; t += 0.05) step();
    return t;
  }
};

std::vector<Vector2> line(const Vector2& from, const Vector2& to) {
  std::vector<Vector2> points;
  const int steps = static_cast<int>((to - from).norm() / 0.1);
  for (int i = 0; i <= steps; ++i) points.push_back(from + (to - from) * (static_cast<double>(i) / steps));
  return points;
}

TEST(PathFollower, FollowsAStraightPathAtFullSpeedToItsEnd) {
  Course course;
  course.path = line({0.0, 0.0}, {7.0, 0.0});
  EXPECT_LT(course.run(), 15.0);
  EXPECT_LT((course.pose.translation() - course.path.back()).norm(), 0.12);
  EXPECT_LT(course.furthest_off_m, 0.08);
}

TEST(PathFollower, TurnsOnTheSpotWhenTheWayIsBehind) {
  Course course;
  course.path = line({0.0, 0.0}, {-3.0, 0.0});
  course.step();
  EXPECT_EQ(course.out.twist.v_mps, 0.0);
  EXPECT_GT(std::abs(course.out.twist.omega_radps), 1.0);
  EXPECT_LT(course.run(), 15.0);
  EXPECT_LT(course.furthest_off_m, 0.25);
}

TEST(PathFollower, TakesACornerOfARightAngle) {
  Course course;
  course.path = line({0.0, 0.0}, {3.0, 0.0});
  for (const Vector2& p : line({3.0, 0.1}, {3.0, 3.0})) course.path.push_back(p);
  EXPECT_LT(course.run(), 20.0);
  EXPECT_LT(course.furthest_off_m, 0.45);
}

TEST(PathFollower, SaysSoWhenNothingLeadsOn) {
  Course course;
  course.path = line({0.0, 0.0}, {3.0, 0.0});
  course.obstacles = line({0.30, -3.0}, {0.30, 3.0});
  course.step();
  EXPECT_TRUE(course.out.blocked);
  EXPECT_EQ(course.out.twist, Twist2{});
}

/// A wall across the way, with a door whose middle is at y = `middle_m`.
std::vector<Vector2> wall_with_door(double x, double middle_m, double width_m) {
  std::vector<Vector2> wall = line({x, middle_m + 0.5 * width_m}, {x, 2.0});
  for (const Vector2& p : line({x, middle_m - 0.5 * width_m}, {x, -2.0})) wall.push_back(p);
  return wall;
}

TEST(PathFollower, GetsThroughADoorOfTwoThirdsOfAMetreThoughThePathPassesItsJamb) {
  // As a map has it that is a hand's breadth off.
  for (const double off_m : {-0.1, -0.05, 0.0, 0.05, 0.1}) {
    Course course;
    course.path = line({0.0, 0.0}, {3.0, 0.0});
    course.obstacles = wall_with_door(1.5, off_m, 0.66);
    EXPECT_LT(course.run(), 60.0) << off_m;
  }
}

TEST(PathFollower, TurnsPastAJambThatIsAtItsNoseAndGoesOn) {
  for (const double side : {-1.0, 1.0}) {
    Course course;
    course.path = line({0.0, 0.0}, {2.0, 0.0});
    course.obstacles = {{0.27, side * 0.24}, {0.30, side * 0.24}};  // in the way of the front's corner
    course.step();
    EXPECT_FALSE(course.out.blocked);
    EXPECT_EQ(course.out.twist.v_mps, 0.0);
    EXPECT_LT(course.out.twist.omega_radps * side, 0.0) << "away from it";
    EXPECT_LT(course.run(), 30.0);
  }
}

TEST(PathFollower, ArrivesFromAnywhereAndGoesRoundAPost) {
  EXPECT_TRUE(rc::check([] {
    Course course;
    course.pose.theta_rad = *rc::gen::inRange(-314, 315) * 0.01;
    course.pose.y_m = *rc::gen::inRange(-20, 21) * 0.01;
    course.path = line({0.0, 0.0}, {4.0, 0.0});
    course.obstacles = {{2.0, *rc::gen::element(-1.0, 1.0) * 0.45}};
    RC_ASSERT(course.run(40.0) < 40.0);
  }));
}

}  // namespace
}  // namespace topo::motion
