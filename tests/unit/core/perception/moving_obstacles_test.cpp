// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/perception/moving_obstacles.hpp"

#include <gtest/gtest.h>

#include "core/perception/footprint_sweep.hpp"
#include "tests/unit/core/motion/moving_scene.hpp"

namespace topo::perception {
namespace {

using motion::box_room;
using motion::legs;
using motion::MovingScene;
using motion::Walking;
using motion::Wall;

using types::Vector2;

std::vector<Walking> walkers(bool on_legs, const Vector2& at, const Vector2& velocity_mps) {
  return on_legs ? legs(at, velocity_mps) : std::vector<Walking>{{at, velocity_mps}};
}

Vector2 heading(double degrees, double speed_mps) {
  return {speed_mps * std::cos(degrees * types::kDegree_rad),
          speed_mps * std::sin(degrees * types::kDegree_rad)};
}

TEST(MovingObstacles, KnowsHowAPersonWalksBeforeASecondIsOver) {
  for (const double speed_mps : {0.5, 1.2, 1.6})
    for (const double degrees : {90.0, 120.0, 180.0})
      for (const bool on_legs : {false, true}) {
        MovingScene scene(1);
        scene.walls = box_room(-4.0, -4.0, 8.0, 4.0);
        const Vector2 velocity = heading(degrees, speed_mps);
        scene.walkers = walkers(on_legs, Vector2(2.5, 0.0) - 1.0 * velocity, velocity);
        while (scene.now_s() < 1.0) scene.step();
        ASSERT_EQ(scene.moving().size(), 1U) << speed_mps << " " << degrees << " " << on_legs;
        const MovingObstacle& one = scene.moving().front();
        EXPECT_LT((one.velocity_mps - velocity).norm(), on_legs ? 0.3 : 0.15)
            << speed_mps << " " << degrees << " " << on_legs << ": " << one.velocity_mps.transpose();
        EXPECT_LT((one.centre - Vector2(2.5, 0.0)).norm(), 0.35);
      }
}

/// Rooms with a door between, a pillar, a chair's legs and a box.
std::vector<Wall> rooms() {
  std::vector<Wall> walls = box_room(-3.0, -2.0, 9.0, 2.5);
  const auto add = [&](const std::vector<Wall>& more) {
    walls.insert(walls.end(), more.begin(), more.end());
  };
  add({{{3.0, -2.0}, {3.0, -0.6}}, {{3.1, -2.0}, {3.1, -0.6}}, {{3.0, -0.6}, {3.1, -0.6}}});
  add({{{3.0, 0.6}, {3.0, 2.5}}, {{3.1, 0.6}, {3.1, 2.5}}, {{3.0, 0.6}, {3.1, 0.6}}});
  add(box_room(1.2, 1.2, 1.5, 1.5));
  add(box_room(5.0, -1.4, 5.4, -1.0));
  for (const double x : {6.0, 6.4})
    for (const double y : {1.2, 1.6}) add(box_room(x, y, x + 0.04, y + 0.04));
  return walls;
}

TEST(MovingObstacles, WhatStandsNeverMovesHoweverTheRobotGoes) {
  struct Leg {
    double seconds;
    types::Twist2 twist;
    double slip;
  };
  const std::vector<Leg> course{{2.0, {0.0, 1.4}, 0.0}, {2.0, {0.0, -1.4}, 0.0}, {6.0, {0.7, 0.0}, 0.0},
                                {0.5, {0.7, 0.0}, 0.5}, {2.0, {0.3, -0.1}, 0.0}, {3.0, {0.0, 1.2}, 0.0},
                                {0.5, {0.0, 1.2}, 0.6}, {3.0, {0.4, 0.6}, 0.0},  {2.0, {0.2, -1.0}, 0.0},
                                {0.6, {0.3, 0.0}, 0.4}};
  for (unsigned seed = 1; seed <= 2; ++seed) {
    MovingScene scene(seed);
    scene.walls = rooms();
    scene.free_of_gate = true;
    std::size_t moved = 0;
    for (const Leg& leg : course) {
      scene.wanted = leg.twist;
      scene.slip = leg.slip;
      for (const double end_s = scene.now_s() + leg.seconds; scene.now_s() < end_s;) {
        scene.step();
        moved += scene.moving().size();
      }
    }
    EXPECT_EQ(moved, 0U) << seed;
  }
}

struct Encounter {
  bool on_legs = false;
  double speed_mps = 1.0, degrees = 90.0;
  double late_s = 0.0;  ///< of the walker, at (0, 0), where the robot would be after three seconds
  bool takes_all_for_standing = false;
};

struct Outcome {
  bool touched = false;
  double contact_speed_mps = 0.0;  ///< of the hull's fastest point, when it is touched first
  double way_m = 0.0;
  double stood_s = 0.0;
};

Outcome meet(const Encounter& e, unsigned seed, double until_s = 7.0) {
  constexpr double kMeet_s = 3.0, kSpeed_mps = 0.7, kStands_mps = 0.01;
  MovingScene scene(seed);
  scene.walls = box_room(-6.0, -6.0, 6.0, 6.0);
  scene.takes_all_for_standing = e.takes_all_for_standing;
  scene.wanted = {kSpeed_mps, 0.0};
  scene.set_off();
  scene.pose = {-kSpeed_mps * kMeet_s, 0.0, 0.0};
  const Vector2 velocity = heading(e.degrees, e.speed_mps);
  scene.walkers = walkers(e.on_legs, -(kMeet_s + e.late_s) * velocity, velocity);
  Outcome result;
  while (scene.now_s() < until_s) {
    scene.step();
    const double fastest = std::abs(scene.twist.v_mps) +
                           types::reach_m(scene.limits.footprint) * std::abs(scene.twist.omega_radps);
    if (fastest < kStands_mps) result.stood_s += 0.05;
    if (!result.touched && scene.gap_m() < 0.0) {
      result.touched = true;
      result.contact_speed_mps = fastest;
    }
  }
  result.way_m = scene.pose.x_m + kSpeed_mps * kMeet_s;
  return result;
}

TEST(MovingObstacles, TheRobotStandsBeforeWhatComesTouchesIt) {
  std::mt19937 random(5);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int hit_when_all_stands = 0;
  for (int i = 0; i < 40; ++i) {
    Encounter e{i % 2 == 0, between(0.5, 1.6), (i % 4 < 2 ? 1.0 : -1.0) * between(60.0, 180.0),
                between(-0.9, 0.9)};
    const Outcome with = meet(e, 7, 5.0);
    EXPECT_LT(with.contact_speed_mps, 0.02)
        << "when touched by " << (e.on_legs ? "legs, " : "a cylinder, ") << e.speed_mps << " m/s at "
        << e.degrees << " degrees, " << e.late_s << " s late";
    e.takes_all_for_standing = true;
    if (i % 4 == 0 && meet(e, 7, 5.0).contact_speed_mps > 0.1) ++hit_when_all_stands;
  }
  EXPECT_GT(hit_when_all_stands, 2) << "of 10: these encounters are no test";
}

TEST(MovingObstacles, NothingHoldsUpTheRobotWhenItGoesByBehindItOrAway) {
  const auto costs_m = [](double speed_mps, double degrees, double late_s) {
    const auto way_m = [&](bool all_stands) {
      return meet({false, speed_mps, degrees, late_s, all_stands}, 3).way_m;
    };
    return way_m(true) - way_m(false);
  };
  EXPECT_LT(costs_m(1.2, 90.0, -3.0), 0.05) << "it has passed long before";
  EXPECT_LT(costs_m(1.2, 90.0, 3.0), 0.05) << "it passes when the robot is gone";
  EXPECT_LT(costs_m(1.0, 0.0, -3.0), 0.05) << "it goes on ahead";
}

TEST(MovingObstacles, TheRobotGoesOnWhenThePersonIsPast) {
  for (const double late_s : {-0.4, 0.0, 0.4}) {
    const Outcome c = meet({false, 0.8, 90.0, late_s}, 5, 9.0);
    EXPECT_GT(c.way_m, 3.5) << late_s;
    EXPECT_LT(c.stood_s, 3.0) << late_s;
  }
}

TEST(MovingObstacles, ATurnOnTheSpotEndsBeforeThePersonBesideTouchesIt) {
  int touches = 0;
  for (const double y_m : {0.35, 0.45, 0.55})
    for (const double late_s : {0.0, 0.3, 0.6}) {
      MovingScene scene(11);
      scene.walls = box_room(-4.0, -4.0, 4.0, 4.0);
      scene.walkers = {{{3.0 + late_s, y_m}, {-1.0, 0.0}, 0.2}};
      scene.wanted = {0.0, 1.0};
      scene.track_error = 0.0;
      bool touched = false;
      while (scene.now_s() < 4.0 && !touched) {
        scene.step();
        touched = scene.gap_m() < 0.0;
        EXPECT_LT(touched ? std::abs(scene.twist.omega_radps) : 0.0, 0.05) << y_m << " " << late_s;
      }
      touches += touched ? 1 : 0;
    }
  EXPECT_GT(touches, 3) << "of 9: these encounters are no test";
}

TEST(PoseAt, FollowsTheTwistForAShortWhile) {
  types::Odometry odometry;
  odometry.stamp = types::stamp_from_seconds(5.0);
  odometry.T_odom_base = types::Transform2<types::Odom, types::Base>(1.0, 2.0, 1.5);
  odometry.twist = {0.8, -0.5};
  const auto after = [&](double s) { return pose_at(odometry, odometry.stamp + types::from_seconds(s)); };
  EXPECT_EQ(after(0.0), odometry.T_odom_base.se2());
  // On the arc of radius 1.6 m.
  const types::Se2 moved = odometry.T_odom_base.se2().inverse() * after(0.2);
  EXPECT_NEAR(moved.theta_rad, -0.1, 1e-12);
  EXPECT_NEAR(moved.x_m, 1.6 * std::sin(0.1), 1e-3);
  EXPECT_NEAR(moved.y_m, -1.6 * (1.0 - std::cos(0.1)), 1e-3);
  EXPECT_EQ(after(0.4), after(0.3)) << "no farther";
  EXPECT_EQ(after(100.0), after(0.3));
  EXPECT_EQ(after(-100.0), after(-0.3));
  odometry.twist = {};
  EXPECT_EQ(after(0.25), odometry.T_odom_base.se2());
}

TEST(MovingObstacles, AreNearestFirstAndForgotten) {
  MovingScene scene(2);
  scene.walls = box_room(-6.0, -6.0, 8.0, 6.0);
  for (const Vector2& at : {Vector2(3.6, -2.4), Vector2(1.8, 0.4), Vector2(2.7, -0.9)})
    scene.walkers.push_back({at, {0.0, 1.0}, 0.2});
  while (scene.now_s() < 1.2) scene.step();
  ASSERT_EQ(scene.moving().size(), 3U);
  for (std::size_t i = 1; i < 3; ++i)
    EXPECT_LE(scene.moving()[i - 1].centre.norm(), scene.moving()[i].centre.norm());

  MovingObstacles tracker;
  std::array<MovingObstacle, MovingObstacles::kMax> out{};
  EXPECT_EQ(tracker.around({}, types::stamp_from_seconds(1.0), out), 0U) << "before the first scan";
  tracker.forget();
  EXPECT_EQ(tracker.around({}, types::stamp_from_seconds(1.0), out), 0U);
}

}  // namespace
}  // namespace topo::perception
