// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/perception/look_match.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "tests/unit/core/motion/surroundings.hpp"

namespace topo::perception {
namespace {

using motion::empty_scan;

using types::Se2;
using types::Vector2;

/// What a scanner sees in a room of 6 by 4 metres with a corner that stands in, with noise.
std::unique_ptr<ScanLook> look_from(const Se2& at, unsigned seed) {
  auto scan = empty_scan(types::stamp_from_seconds(1.0));
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 0.03);
  for (std::size_t i = 0; i < scan->beams; ++i) {
    const double angle = at.theta_rad + static_cast<double>(scan->angle_rad(i));
    double range_m = 0.0;
    for (Vector2 p = at.translation();
         std::abs(p.x()) < 3.0 && std::abs(p.y()) < 2.0 && (p.x() < 2.0 || p.y() < 1.0); range_m += 0.005)
      p = at.translation() + range_m * Vector2(std::cos(angle), std::sin(angle));
    scan->range_m[i] = static_cast<float>(range_m + noise(random));
  }
  auto look = std::make_unique<ScanLook>();
  EXPECT_TRUE(take_look(*scan, 0.0, *look));
  return look;
}

TEST(LookMatch, MendsAReckoningOfWheelsThatSlipped) {
  const Se2 before{-0.5, 0.2, 0.3};
  for (const Se2 moved : {Se2{0.07, 0.0, 0.0}, {0.03, 0.0, 0.14}, {0.0, 0.0, -0.14}}) {
    const auto a = look_from(before, 1), b = look_from(before * moved, 2);
    for (const Se2 error : {Se2{}, {0.05, 0.0, 0.0}, {0.02, 0.0, 0.12}, {0.0, 0.0, -0.12}}) {
      const LookMatch match = match_looks(*a, *b, moved * error, {});
      EXPECT_LT((match.T_before_now.translation() - moved.translation()).norm(), 0.01);
      EXPECT_LT(std::abs(types::wrap_angle(match.T_before_now.theta_rad - moved.theta_rad)), 0.008);
      EXPECT_GT(match.explained, 0.95);
    }
  }
}

TEST(LookMatch, SaysWhenTheTwoDoNotFit) {
  const auto a = look_from({-0.5, 0.2, 0.3}, 1), b = look_from({1.0, -1.0, 1.9}, 2);
  EXPECT_LT(match_looks(*a, *b, {}, {}).explained, 0.8);
}

TEST(LookMatch, WhereNothingIsSeenTheGuessHolds) {
  auto blind = std::make_unique<ScanLook>();
  ASSERT_TRUE(take_look(*empty_scan(types::stamp_from_seconds(1.0)), 0.0, *blind));
  const LookMatch match = match_looks(*blind, *blind, {0.1, 0.0, 0.05}, {});
  EXPECT_EQ(match.T_before_now, (Se2{0.1, 0.0, 0.05}));
  EXPECT_EQ(match.explained, 0.0);
}

TEST(LookMatch, BackwardsIsTheOtherWayRound) {
  const Se2 before{0.3, -0.4, 1.0}, moved{0.06, 0.01, 0.08};
  const auto a = look_from(before, 3), b = look_from(before * moved, 4);
  const Se2 there = match_looks(*a, *b, {}, {}).T_before_now, back = match_looks(*b, *a, {}, {}).T_before_now;
  const Se2 round = there * back;
  EXPECT_LT(round.translation().norm(), 0.02);
  EXPECT_LT(std::abs(round.theta_rad), 0.01);
  const LookMatch same = match_looks(*a, *a, {}, {});
  EXPECT_LT(same.T_before_now.translation().norm(), 1e-3);
  EXPECT_EQ(same.explained, 1.0);
}

/// Two walls without ends: nothing tells how far the robot went along them.
TEST(LookMatch, AlongACorridorTheGuessHolds) {
  const auto look_in_corridor = [](double y_m, double heading_rad) {
    auto scan = empty_scan(types::stamp_from_seconds(1.0));
    for (std::size_t i = 0; i < scan->beams; ++i) {
      const double up = std::sin(heading_rad + static_cast<double>(scan->angle_rad(i)));
      const double range_m = up > 0.0 ? (1.0 - y_m) / up : (-1.0 - y_m) / up;
      if (range_m < 8.0) scan->range_m[i] = static_cast<float>(range_m);
    }
    auto look = std::make_unique<ScanLook>();
    EXPECT_TRUE(take_look(*scan, 0.0, *look));
    return look;
  };
  const auto before = look_in_corridor(0.0, 0.0), now = look_in_corridor(0.05, 0.1);
  for (const double guess_m : {-0.1, 0.0, 0.2}) {
    const Se2 found = match_looks(*before, *now, {guess_m, 0.0, 0.0}, {}).T_before_now;
    EXPECT_NEAR(found.x_m, guess_m, 0.02);
    EXPECT_NEAR(found.y_m, 0.05, 0.005);
    EXPECT_NEAR(found.theta_rad, 0.1, 0.005);
  }
}

}  // namespace
}  // namespace topo::perception
