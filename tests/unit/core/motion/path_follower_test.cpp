// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/motion/path_follower.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <optional>
#include <vector>

#include "core/perception/footprint_sweep.hpp"
#include "tests/unit/core/motion/generators.hpp"

namespace topo::motion {
namespace {

using types::Se2;
using types::Twist2;
using types::Vector2;

/// A robot that does at once what it is told.
struct Course {
  types::RobotLimits limits;
  std::vector<Vector2> path;
  std::optional<double> turn_to_rad;
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
    in.turn_to_rad = turn_to_rad;
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

TEST(PathFollower, TurnsToAnyHeadingWithoutMovingOn) {
  EXPECT_TRUE(rc::check([] {
    Course course;
    course.pose = {1.0, 2.0, *rc::gen::inRange(-314, 314) / 100.0};
    course.turn_to_rad = *rc::gen::inRange(-314, 314) / 100.0;
    RC_ASSERT(course.run() < 10.0);
    RC_ASSERT(std::abs(types::wrap_angle(course.pose.theta_rad - *course.turn_to_rad)) < 0.25);
    RC_ASSERT((course.pose.translation() - Vector2(1.0, 2.0)).norm() < 1e-9);
  }));
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

/// A path that leads back, and posts round about a robot whose front corners are `spare_m` from them in a
/// turn.
FollowOutput turn_among_posts(double spare_m, const Twist2& twist, double from_x_m = 0.0) {
  types::RobotLimits limits;
  limits.footprint.swing_radius_m = types::kP3dx.swing_radius_m;
  const double away_m = limits.footprint.swing_radius_m + spare_m;
  std::vector<Vector2> path = line({0.0, 0.0}, {-3.0, 0.0});
  const std::vector<Vector2> posts = {{from_x_m, away_m}, {from_x_m, -away_m}};
  FollowInput in;
  in.path_odom = path;
  in.obstacles_base = posts;
  in.twist = twist;
  in.blind_s = 2.15;
  in.alive_s = 0.2;
  in.limits = &limits;
  return PathFollower().step(in);
}

/// A robot turned past a speck with the margin that the gate keeps, less the noise of a range, and stood for
/// twelve minutes between speck and wall: the gate did not let it back.
TEST(PathFollower, BeginsATurnWithMoreMarginThanItIsEndedWith) {
  const double kept_m = types::RobotLimits{}.turn_margin_m, extra_m = FollowerTurnParams{}.extra_margin_m;
  EXPECT_TRUE(turn_among_posts(kept_m + 0.5 * extra_m, {}).blocked);
  EXPECT_FALSE(turn_among_posts(kept_m + 1.1 * extra_m, {}).blocked);
  for (const double omega_radps : {-0.8, 0.8})
    EXPECT_FALSE(turn_among_posts(kept_m + 0.5 * extra_m, {0.0, omega_radps}).blocked);
  EXPECT_TRUE(turn_among_posts(0.5 * kept_m, {0.0, 0.8}).blocked);
}

TEST(PathFollower, BeginsATurnOnlyWhereItCanMakeItAfterRollingToAStop) {
  constexpr double kSpare_m = 0.045, kSpeed_mps = 0.3;
  const double rolls_m = kSpeed_mps * kSpeed_mps / (2.0 * types::RobotLimits{}.deceleration_mps2);
  EXPECT_FALSE(turn_among_posts(kSpare_m, {}).blocked);
  EXPECT_FALSE(turn_among_posts(kSpare_m, {kSpeed_mps, 0.0}, rolls_m).blocked);
  EXPECT_FALSE(turn_among_posts(0.03, {}, 0.15).blocked) << "it stands short of the posts";
  EXPECT_TRUE(turn_among_posts(0.03, {kSpeed_mps, 0.0}, 0.15).blocked) << "it rolls on to them";
}

/// A post beside the flank, between the two margins: the turn leads along it at first, and then the tail
/// meets it.
TEST(PathFollower, AWiderMarginFreesNoTurn) {
  types::RobotLimits limits;
  limits.footprint.swing_radius_m = types::kP3dx.swing_radius_m;
  for (const double side : {-1.0, 1.0}) {
    const std::vector<Vector2> posts = {{0.13, side * 0.245}};
    FollowInput in;
    in.turn_to_rad = -side * 1.5;
    in.obstacles_base = posts;
    in.limits = &limits;
    EXPECT_LE(PathFollower().step(in).twist.omega_radps * -side, 0.0) << "not past the post";
  }
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

TEST(PathFollower, PassesADoorOfTwoThirdsOfAMetreBesideItsJamb) {
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

/// A bent path and some posts, about a robot that drives.
struct Scenery {
  std::vector<Vector2> path, posts;
  Se2 pose;
  Twist2 twist;

  Scenery() {
    Se2 along;
    const double bend = uniform(-0.15, 0.15);
    for (int i = 0; i < 40; ++i) {
      path.push_back(along.translation());
      along = along * Se2{0.1, 0.0, i < 20 ? bend : -bend};
    }
    for (int count = *rc::gen::inRange(0, 12); count > 0; --count)
      posts.emplace_back(uniform(-1.0, 3.0), uniform(-2.0, 2.0));
    pose = {uniform(-0.2, 0.5), uniform(-0.3, 0.3), uniform(-3.1, 3.1)};
    twist = {uniform(0.0, 0.7), 0.0};
  }
  void mirror() {
    for (auto* points : {&path, &posts})
      for (Vector2& p : *points) p.y() *= -1.0;
    pose = {pose.x_m, -pose.y_m, -pose.theta_rad};
    twist.omega_radps *= -1.0;
  }
  [[nodiscard]] FollowOutput follow(const types::RobotLimits& limits, bool ends_at_goal = true) const {
    std::vector<Vector2> seen;
    for (const Vector2& p : posts) seen.push_back(pose.inverse() * p);
    FollowInput in;
    in.T_odom_base = pose;
    in.twist = twist;
    in.path_odom = path;
    in.path_number = 1;
    in.ends_at_goal = ends_at_goal;
    in.obstacles_base = seen;
    in.blind_s = 0.7;
    in.alive_s = 0.2;
    in.limits = &limits;
    return PathFollower().step(in);
  }
};

TEST(PathFollower, FollowsTheMirroredPathTheMirroredWay) {
  const types::RobotLimits limits;
  EXPECT_TRUE(rc::check([&] {
    Scenery scenery;
    const FollowOutput one = scenery.follow(limits);
    scenery.mirror();
    const FollowOutput other = scenery.follow(limits);
    RC_ASSERT(std::abs(one.twist.v_mps - other.twist.v_mps) < 1e-9);
    RC_ASSERT(std::abs(one.twist.omega_radps + other.twist.omega_radps) < 1e-9);
    RC_ASSERT(std::abs(one.turn_rad + other.turn_rad) < 1e-9);
    RC_ASSERT(one.blocked == other.blocked);
    RC_ASSERT(one.arrived == other.arrived);
  }));
}

TEST(PathFollower, KeepsItsLimitsAndStandsWhenBlocked) {
  EXPECT_TRUE(rc::check([] {
    types::RobotLimits limits;
    limits.v_max_mps = uniform(0.1, 0.7);
    limits.omega_max_radps = uniform(0.2, 1.4);
    const FollowOutput out = Scenery().follow(limits);
    RC_ASSERT(out.twist.v_mps >= 0.0);
    RC_ASSERT(out.twist.v_mps <= limits.v_max_mps);
    RC_ASSERT(std::abs(out.twist.omega_radps) <= limits.omega_max_radps + 1e-12);
    if (out.blocked) RC_ASSERT(out.twist == Twist2{});
    if (!out.blocked) RC_ASSERT(out.twist != Twist2{});
  }));
}

TEST(PathFollower, TheArcThatItTakesIsFreeForItsBlindTime) {
  EXPECT_TRUE(rc::check([] {
    const types::RobotLimits limits;
    const Scenery scenery;
    const FollowOutput out = scenery.follow(limits);
    if (out.twist.v_mps == 0.0) return;
    const double rolls_m = out.twist.v_mps * 0.7;
    for (const Vector2& p : scenery.posts) {
      const Vector2 seen = scenery.pose.inverse() * p;
      if (perception::contains(types::grown(limits.footprint, limits.margin_m), seen)) continue;
      const double at_s = perception::contact_time_s(seen, out.twist, limits.footprint);
      RC_ASSERT(at_s * out.twist.v_mps > rolls_m);
    }
  }));
}

TEST(PathFollower, WithoutAPathOrLimitsNothingIsDone) {
  const types::RobotLimits limits;
  const std::vector<Vector2> path = line({0.0, 0.0}, {2.0, 0.0});
  FollowInput in;
  in.limits = &limits;
  PathFollower follower;
  for (const bool has_path : {false, true}) {
    if (has_path) in.path_odom = path;
    in.limits = has_path ? nullptr : &limits;
    const FollowOutput out = follower.step(in);
    EXPECT_EQ(out.twist, Twist2{});
    EXPECT_FALSE(out.arrived || out.blocked);
  }
}

TEST(PathFollower, ArrivesAtAGoalAloneAndKeepsThePathOfOneNumber) {
  const types::RobotLimits limits;
  const std::vector<Vector2> here = line({-1.0, 0.0}, {0.0, 0.0}), ahead = line({0.0, 0.0}, {3.0, 0.0});
  FollowInput in;
  in.limits = &limits;
  in.path_odom = here;
  in.path_number = 1;
  PathFollower follower;
  EXPECT_FALSE(follower.step(in).arrived) << "the path goes on from there";
  in.ends_at_goal = true;
  EXPECT_TRUE(follower.step(in).arrived);
  in.path_odom = ahead;
  EXPECT_TRUE(follower.step(in).arrived) << "by its number it is the same";
  in.path_number = 2;
  EXPECT_FALSE(follower.step(in).arrived);
  EXPECT_GT(follower.step(in).twist.v_mps, 0.0);
  in.path_odom = here;
  EXPECT_FALSE(follower.step(in).arrived);
  follower.reset();
  EXPECT_TRUE(follower.step(in).arrived) << "after a reset every path is new";
}

/// Its end is where it begins, and nears at the speed of an end.
TEST(PathFollower, APathOfOnePointIsDrivenToSlowly) {
  Course course;
  course.path = {{1.5, 0.6}};
  EXPECT_LT(course.run(), 60.0);
  EXPECT_LT((course.pose.translation() - course.path.front()).norm(), 0.13);
}

}  // namespace
}  // namespace topo::motion
