// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/perception/blind_spot.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/motion/path_follower.hpp"
#include "core/perception/footprint_sweep.hpp"
#include "tests/unit/core/motion/surroundings.hpp"

namespace topo::perception {
namespace {

using motion::empty_scan;

using types::Se2;
using types::Vector2;

/// A robot that goes where it is put, past round posts.
struct Passage {
  std::vector<Vector2> posts;  ///< centres in odom
  double post_radius_m = 0.05;
  std::vector<MovingObstacle> moving;  ///< in base
  double view_rad = 1.5 * std::numbers::pi;
  bool blinded = false;           ///< no beam measures anything
  bool upside_down = false;       ///< the beams come clockwise
  types::Duration clock_error{};  ///< of when the beams were measured
  Se2 T_base_laser{0.021, 0.0, 0.0};
  types::Footprint outline{0.210, 0.301, 0.2125, 0.267};
  BlindSpot blind_spot;
  types::Stamp now = types::stamp_from_seconds(100.0);

  void look_from(const Se2& pose) {
    now += std::chrono::milliseconds(50);
    const auto scan = empty_scan(now);
    scan->first_beam += clock_error;
    scan->geometry.angle_min_rad = static_cast<float>(-0.5 * view_rad);
    scan->beams = static_cast<std::uint16_t>(
        std::lround(view_rad / static_cast<double>(scan->geometry.angle_increment_rad)) + 1);
    if (upside_down) {
      scan->geometry.angle_min_rad *= -1.0F;
      scan->geometry.angle_increment_rad *= -1.0F;
    }
    for (std::size_t i = 0; i < scan->beams; ++i) {
      const Se2 at = pose * T_base_laser;
      const double angle = at.theta_rad + static_cast<double>(scan->angle_rad(i));
      for (const Vector2& post : posts) {
        const Vector2 to = post - at.translation();
        const double along = to.dot(Vector2(std::cos(angle), std::sin(angle)));
        const double square = post_radius_m * post_radius_m - to.squaredNorm() + along * along;
        if (!(along > 0.0 && square > 0.0)) continue;
        const auto range_m = static_cast<float>(along - std::sqrt(square));
        if (!(scan->range_m[i] < range_m)) scan->range_m[i] = range_m;
      }
    }
    if (blinded) scan->range_m.fill(types::kInvalid);
    std::vector<ScanPoint> points(scan->beams);
    points.resize(scan_points(*scan, T_base_laser, {}, points));
    types::Odometry odometry;
    odometry.stamp = now;
    odometry.T_odom_base = types::Transform2<types::Odom, types::Base>(pose);
    blind_spot.update(*scan, T_base_laser, points, moving, outline, odometry);
  }
  void drive(const Se2& from, const Se2& to) {
    const double way =
        (to.translation() - from.translation()).norm() + std::abs(to.theta_rad - from.theta_rad);
    const int steps = std::max(1, static_cast<int>(std::ceil(way / 0.03)));
    for (int i = 0; i <= steps; ++i) look_from(types::interpolate(from, to, static_cast<double>(i) / steps));
  }
  /// How far off the nearest of what is kept is from a place in odom.
  [[nodiscard]] double off_m(const Vector2& place, const Se2& pose) const {
    double nearest_m = HUGE_VAL;
    for (const Vector2& p : kept(pose)) nearest_m = std::min(nearest_m, (pose * p - place).norm());
    return nearest_m;
  }
  [[nodiscard]] std::vector<Vector2> kept(const Se2& pose) const {
    std::vector<ScanPoint> out(blind_spot.size());
    blind_spot.put_points(pose, out);
    std::vector<Vector2> points;
    for (const ScanPoint& point : out) {
      EXPECT_FALSE(point.forward);
      EXPECT_TRUE(point.remembered);
      points.push_back(point.p_base);
    }
    return points;
  }
};

TEST(BlindSpot, KnowsThePostThatTheRobotHasPassed) {
  Passage passage;
  passage.posts = {{0.6, 0.32}};
  passage.drive({0.0, 0.0, 0.0}, {0.9, 0.0, 0.0});
  const auto kept = passage.kept({0.9, 0.0, 0.0});
  ASSERT_GE(kept.size(), 2U);
  for (const Vector2& p : kept)
    EXPECT_LT(std::abs((p - Vector2(-0.3, 0.32)).norm() - 0.05), 0.02) << p.transpose();
}

TEST(BlindSpot, KnowsThePostWhicheverWayTheScannerLooksAndCounts) {
  for (const double yaw_rad : {0.0, 0.3, -0.3}) {
    for (const bool upside_down : {false, true}) {
      Passage passage;
      passage.T_base_laser.theta_rad = yaw_rad;
      passage.upside_down = upside_down;
      passage.view_rad = 4.0 * std::numbers::pi / 3.0;  // a URG-04LX
      passage.posts = {{0.6, 0.32}, {0.6, -0.32}};
      passage.drive({0.0, 0.0, 0.0}, {0.9, 0.0, 0.0});
      for (const Vector2& post : passage.posts)
        EXPECT_LT(passage.off_m(post, {0.9, 0.0, 0.0}), 0.07) << yaw_rad << " " << upside_down;
      passage.posts.clear();
      passage.drive({0.9, 0.0, 0.0}, {0.9, 0.0, 3.1});
      passage.drive({0.9, 0.0, 3.1}, {0.9, 0.0, 0.0});
      EXPECT_EQ(passage.blind_spot.size(), 0U) << yaw_rad << " " << upside_down;
    }
  }
}

// Walls that leave the view a hair's breadth at a time must not push out what left it before.
TEST(BlindSpot, KnowsThePostHoweverSlowlyTheRobotGoesOn) {
  Passage passage;
  const Vector2 post(0.6, 0.32);
  passage.posts = {post};
  for (double x = 0.5; x < 1.5; x += 0.01) passage.posts.emplace_back(x, -0.33);
  for (double x = 0.75; x < 1.5; x += 0.01) passage.posts.emplace_back(x, 0.33);
  passage.post_radius_m = 0.02;
  passage.drive({0.0, 0.0, 0.0}, {0.9, 0.0, 0.0});
  Se2 pose{0.9, 0.0, 0.0};
  ASSERT_LT(passage.off_m(post, pose), 0.04);
  for (int i = 0; i < 300; ++i) {
    pose.x_m += 0.0002;
    passage.look_from(pose);
  }
  EXPECT_LT(passage.off_m(post, pose), 0.04);
}

TEST(BlindSpot, WhatComesIntoViewAgainIsTheScannersToTell) {
  Passage passage;
  passage.posts = {{0.6, 0.32}};
  passage.drive({0.0, 0.0, 0.0}, {0.9, 0.0, 0.0});
  passage.posts.clear();
  passage.look_from({0.9, 0.0, 0.0});
  EXPECT_GT(passage.blind_spot.size(), 0U) << "it cannot see that the post is gone";
  passage.drive({0.9, 0.0, 0.0}, {0.9, 0.0, 1.5});
  EXPECT_EQ(passage.blind_spot.size(), 0U);
}

TEST(BlindSpot, WhereNothingIsMeasuredTheScannerTellsNothing) {
  Passage passage;
  passage.posts = {{-0.2, 0.35}};
  passage.look_from({});
  ASSERT_GT(passage.blind_spot.size(), 0U);
  passage.blinded = true;
  passage.look_from({});
  EXPECT_LT(passage.off_m(passage.posts.front(), {}), 0.07);
  passage.blinded = false;
  passage.posts.clear();
  passage.look_from({});
  EXPECT_EQ(passage.blind_spot.size(), 0U);
}

TEST(BlindSpot, ForgetsWhatIsFarOffAndWhatIsOld) {
  Passage far;
  far.posts = {{0.6, 0.32}};
  far.drive({0.0, 0.0, 0.0}, {1.5, 0.0, 0.0});
  EXPECT_EQ(far.blind_spot.size(), 0U);

  Passage old;
  old.posts = {{0.6, 0.32}};
  old.drive({0.0, 0.0, 0.0}, {0.9, 0.0, 0.0});
  old.posts.clear();
  old.now += std::chrono::seconds(59);
  old.look_from({0.9, 0.0, 0.0});
  EXPECT_GT(old.blind_spot.size(), 0U);
  old.now += std::chrono::seconds(2);
  old.look_from({0.9, 0.0, 0.0});
  EXPECT_EQ(old.blind_spot.size(), 0U);
}

/// Else a robot would back over ground where it has forgotten what stands there.
TEST(BlindSpot, KnowsNoGroundFromBeforeItForgot) {
  Passage passage;
  passage.drive({0.0, 0.0, 0.0}, {0.9, 0.0, 0.0});
  const auto seen_m = [&](const Se2& pose) {
    return passage.blind_spot.seen_behind_m(pose, passage.outline, passage.now, 0.1);
  };
  EXPECT_EQ(seen_m({0.9, 0.0, 1.5}), 0.1);
  passage.now += BlindSpotParams{}.kept - std::chrono::seconds(5);
  EXPECT_EQ(seen_m({0.9, 0.0, 1.5}), 0.1);
  passage.now += std::chrono::seconds(6);
  EXPECT_LT(seen_m({0.9, 0.0, 1.5}), 0.03);
  passage.drive({0.0, 0.0, 0.0}, {0.9, 0.0, 0.0});
  EXPECT_EQ(seen_m({0.9, 0.0, 1.5}), 0.1);
  passage.look_from({5.0, 0.0, 0.0});
  EXPECT_EQ(seen_m({0.9, 0.0, 1.5}), 0.0);
}

TEST(BlindSpot, AScannersClockThatJumpsKeepsNothingAlive) {
  Passage passage;
  passage.posts = {{0.6, 0.32}};
  passage.clock_error = std::chrono::hours(1);
  passage.drive({0.0, 0.0, 0.0}, {0.9, 0.0, 0.0});
  passage.clock_error = {};
  passage.posts.clear();
  passage.look_from({0.9, 0.0, 0.0});
  EXPECT_GT(passage.blind_spot.size(), 0U);
  passage.now += std::chrono::seconds(61);
  passage.look_from({0.9, 0.0, 0.0});
  EXPECT_EQ(passage.blind_spot.size(), 0U);
}

TEST(BlindSpot, KeepsNothingThatMovesAndNothingOfTheRobotItself) {
  Passage moving;
  moving.posts = {{-0.2, 0.35}};
  moving.moving = {{{-0.2, 0.35}, {0.0, 0.5}, 0.05}};
  moving.look_from({});
  EXPECT_EQ(moving.blind_spot.size(), 0U);
  moving.moving.clear();
  moving.look_from({});
  EXPECT_GT(moving.blind_spot.size(), 0U);

  Passage mast;
  mast.posts = {{-0.08, 0.12}};
  mast.look_from({});
  EXPECT_EQ(mast.blind_spot.size(), 0U);
}

TEST(BlindSpot, AReckoningThatBeginsAnewForgetsAll) {
  Passage passage;
  passage.posts = {{0.6, 0.32}};
  passage.drive({0.0, 0.0, 0.0}, {0.9, 0.0, 0.0});
  passage.posts.clear();
  ASSERT_GT(passage.blind_spot.size(), 0U);
  passage.look_from({1.2, 0.0, 0.0});
  EXPECT_EQ(passage.blind_spot.size(), 0U);

  Passage turned;
  turned.posts = {{-0.3, 0.32}};
  turned.drive({-0.9, 0.0, 0.0}, {0.0, 0.0, 0.0});
  turned.posts.clear();
  ASSERT_GT(turned.blind_spot.size(), 0U);
  turned.look_from({0.0, 0.0, -1.5});
  EXPECT_EQ(turned.blind_spot.size(), 0U) << "of another heading, though of the same place";
}

TEST(BlindSpot, NeverKeepsMoreThanItHasRoomForAndAlwaysTheNewest) {
  Passage passage;
  for (double x = -0.5; x < 4.0; x += 0.05)
    for (const double side : {-0.3, 0.3}) passage.posts.emplace_back(x, side);
  passage.post_radius_m = 0.02;
  for (int round = 0; round < 2; ++round) {
    passage.drive({0.0, 0.0, 0.0}, {3.0, 0.0, 0.0});
    passage.drive({3.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
  }
  passage.drive({0.0, 0.0, 0.0}, {2.0, 0.0, 0.0});
  EXPECT_LE(passage.blind_spot.size(), BlindSpot::kMax);
  const auto kept = passage.kept({2.0, 0.0, 0.0});
  for (const double x : {-0.4, -0.3}) {
    for (const double side : {-0.28, 0.28}) {
      double nearest_m = HUGE_VAL;
      for (const Vector2& p : kept) nearest_m = std::min(nearest_m, (p - Vector2(x, side)).norm());
      EXPECT_LT(nearest_m, 0.05) << x << " " << side;
    }
  }
}

// What is kept comes first, and must not cost the end of the scan: the robot's left.
TEST(BlindSpot, TheFollowerHasRoomForItBesideAFullScan) {
  const auto scan = empty_scan(types::stamp_from_seconds(100.0));
  std::fill_n(scan->range_m.begin(), scan->beams, 2.7F);
  std::vector<ScanPoint> points(BlindSpot::kMax + scan->beams);
  for (std::size_t i = 0; i < BlindSpot::kMax; ++i)
    points[i].p_base = {-0.5, 0.04 * static_cast<double>(i % 20) - 0.4};
  (void)scan_points(*scan, {}, {}, std::span(points).subspan(BlindSpot::kMax));
  Surroundings around;
  around.front_scan = scan.get();
  around.points = points;
  std::vector<Vector2> taken(motion::PathFollower::kMaxObstacles);
  taken.resize(collect_obstacles({}, around, 2.8, 0.03, taken));
  EXPECT_LT((taken.back() - points.back().p_base).norm(), 0.05);
}

TEST(BlindSpot, EveryPostThatATurnWouldHitIsKnownHoweverTheRobotCame) {
  EXPECT_TRUE(rc::check([] {
    Passage passage;
    const double side = *rc::gen::element(-1.0, 1.0);
    passage.posts = {{*rc::gen::inRange(50, 62) * 0.01, side * 0.29}};
    const Se2 end{1.0, 0.0, 0.0}, pose{1.0, 0.0, *rc::gen::inRange(0, 40) * -0.01 * side};
    passage.drive({0.0, 0.0, 0.0}, end);
    passage.drive(end, pose);
    const Vector2 post = pose.inverse() * passage.posts.front();
    double nearest_m = HUGE_VAL;
    for (const Vector2& p : passage.kept(pose)) nearest_m = std::min(nearest_m, (p - post).norm());
    RC_ASSERT(nearest_m < 0.08);
  }));
}

}  // namespace
}  // namespace topo::perception
