// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/motion/blind_spot.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/motion/footprint_sweep.hpp"
#include "tests/unit/core/motion/surroundings.hpp"

namespace topo::motion {
namespace {

using types::Se2;
using types::Vector2;

/// A robot that goes where it is put, past round posts.
struct Passage {
  std::vector<Vector2> posts;  ///< centres in odom
  double post_radius_m = 0.05;
  std::vector<MovingObstacle> moving;  ///< in base
  Se2 T_base_laser{0.021, 0.0, 0.0};
  Footprint outline{0.210, 0.301, 0.2125, 0.267};
  BlindSpot blind_spot;
  types::Stamp now = types::stamp_from_seconds(100.0);

  void look_from(const Se2& pose) {
    now += std::chrono::milliseconds(50);
    const auto scan = empty_scan(now);
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
    std::vector<ScanPoint> points(scan->beams);
    points.resize(scan_points(*scan, T_base_laser, points));
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
  [[nodiscard]] std::vector<Vector2> kept(const Se2& pose) const {
    std::vector<ScanPoint> out(blind_spot.size());
    blind_spot.put_points(pose, out);
    std::vector<Vector2> points;
    for (const ScanPoint& point : out) {
      EXPECT_FALSE(point.forward);
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
}  // namespace topo::motion
