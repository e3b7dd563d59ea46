// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/motion/giving_way.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tests/unit/core/motion/generators.hpp"

namespace topo::motion {
namespace {

using types::Twist2;

constexpr double kAlive_s = 0.2;

types::RobotLimits p3dx() {
  types::RobotLimits limits;
  limits.footprint = {0.210, 0.301, 0.2125, 0.267};
  return limits;
}

double scale(const Twist2& twist, const perception::MovingObstacle& one) {
  return giving_way_scale(twist, std::array{one}, kAlive_s, p3dx(), {});
}

TEST(GivingWay, NothingMovesNothingSlows) {
  EXPECT_EQ(giving_way_scale({0.7, 0.0}, {}, kAlive_s, p3dx(), {}), 1.0);
}

TEST(GivingWay, WhatCrossesFarAheadOrBehindOrGoesAwayIsNoReason) {
  EXPECT_EQ(scale({0.7, 0.0}, {{6.0, -1.0}, {0.0, 1.0}, 0.2}), 1.0);
  EXPECT_EQ(scale({0.7, 0.0}, {{-1.5, -1.0}, {0.0, 1.0}, 0.2}), 1.0);
  EXPECT_EQ(scale({0.7, 0.0}, {{1.0, 0.0}, {1.2, 0.0}, 0.2}), 1.0);
  EXPECT_EQ(scale({0.7, 0.0}, {{1.0, 1.0}, {0.0, 1.0}, 0.2}), 1.0);
}

TEST(GivingWay, WhatComesOrCrossesSlowsAndStops) {
  const double crossing = scale({0.7, 0.0}, {{1.0, -1.2}, {0.0, 1.0}, 0.2});
  EXPECT_LT(crossing, 0.8);
  EXPECT_EQ(scale({0.7, 0.0}, {{1.0, 0.0}, {-1.2, 0.0}, 0.2}), 0.0);
}

TEST(GivingWay, ATurnOnTheSpotIsBoundedAsWell) {
  EXPECT_EQ(scale({0.0, 1.4}, {{0.8, 0.3}, {-1.0, 0.0}, 0.2}), 0.0);
  EXPECT_EQ(scale({0.0, 1.4}, {{0.8, 1.5}, {-1.0, 0.0}, 0.2}), 1.0);
}

TEST(GivingWay, WhatIsBesideMayBeLeft) { EXPECT_EQ(scale({0.7, 0.0}, {{-0.2, 0.45}, {0.1, 0.0}, 0.2}), 1.0); }

TEST(GivingWay, WhatItLetsThroughStandsInTime) {
  EXPECT_TRUE(rc::check([] {
    const perception::MovingObstacle one{{uniform(-2.0, 4.0), uniform(-3.0, 3.0)},
                                         {uniform(-1.6, 1.6), uniform(-1.6, 1.6)},
                                         uniform(0.05, 0.4)};
    const Twist2 t{uniform(-0.1, 0.7), uniform(-1.0, 1.0)};
    const double s = scale(t, one);
    RC_ASSERT(s >= 0.0 && s <= 1.0);
    const Twist2 given{s * t.v_mps, s * t.omega_radps};
    RC_ASSERT(s == 0.0 || stands_in_time(given, std::array{one}, kAlive_s, p3dx().margin_m, p3dx(), {}));
  }));
}

std::vector<perception::MovingObstacle> any_movers(int most) {
  std::vector<perception::MovingObstacle> movers;
  for (int count = *rc::gen::inRange(0, most + 1); count > 0; --count)
    movers.push_back({{uniform(-2.0, 4.0), uniform(-3.0, 3.0)},
                      {uniform(-1.6, 1.6), uniform(-1.6, 1.6)},
                      uniform(0.05, 0.4)});
  return movers;
}

TEST(GivingWay, TheMirroredEncounterSlowsAsMuch) {
  EXPECT_TRUE(rc::check([] {
    const auto movers = any_movers(3);
    auto mirrored = movers;
    for (perception::MovingObstacle& one : mirrored) {
      one.centre.y() *= -1.0;
      one.velocity_mps.y() *= -1.0;
    }
    const Twist2 t{uniform(-0.1, 0.7), uniform(-1.0, 1.0)}, other{t.v_mps, -t.omega_radps};
    RC_ASSERT(giving_way_scale(t, movers, kAlive_s, p3dx(), {}) ==
              giving_way_scale(other, mirrored, kAlive_s, p3dx(), {}));
  }));
}

TEST(GivingWay, MoreThatMovesOrALargerMarginLetsNoMoreThrough) {
  EXPECT_TRUE(rc::check([] {
    auto movers = any_movers(2);
    const Twist2 t{uniform(-0.1, 0.7), uniform(-1.0, 1.0)};
    const double scale_before = giving_way_scale(t, movers, kAlive_s, p3dx(), {}),
                 margin_m = uniform(0.0, 0.2);
    const bool stands = stands_in_time(t, movers, kAlive_s, margin_m, p3dx(), {});
    if (!stands) RC_ASSERT(!stands_in_time(t, movers, kAlive_s, margin_m + uniform(0.0, 0.2), p3dx(), {}));
    for (const perception::MovingObstacle& one : any_movers(2)) movers.push_back(one);
    RC_ASSERT(giving_way_scale(t, movers, kAlive_s, p3dx(), {}) <= scale_before);
    if (!stands) RC_ASSERT(!stands_in_time(t, movers, kAlive_s, margin_m, p3dx(), {}));
  }));
}

TEST(GivingWay, TheScaleIsInTwentieths) {
  EXPECT_TRUE(rc::check([] {
    const double parts = 20.0 * giving_way_scale({0.7, 0.3}, any_movers(3), kAlive_s, p3dx(), {});
    RC_ASSERT(std::abs(parts - std::round(parts)) < 1e-9);
    RC_ASSERT((parts >= 0.0 && parts <= 20.0));
  }));
}

/// What stands 1 m ahead is run into by a robot that stops later.
TEST(GivingWay, StandsInTimeWhereItsBrakesSuffice) {
  const perception::MovingObstacle one{{1.0, 0.0}, {0.0, 0.0}, 0.1};
  const auto stands = [&](double v_mps, double alive_s) {
    return stands_in_time({v_mps, 0.0}, std::array{one}, alive_s, 0.05, p3dx(), {});
  };
  EXPECT_TRUE(stands(0.1, 0.2));
  EXPECT_TRUE(stands(0.5, 0.2)) << "0.1 m and 0.31 m of braking";
  EXPECT_FALSE(stands(0.5, 1.0));
  EXPECT_FALSE(stands(1.0, 0.2));
  EXPECT_TRUE(stands(-1.0, 0.2));
  EXPECT_TRUE(stands_in_time({1.0, 0.0}, {}, 5.0, 0.05, p3dx(), {}));
}

}  // namespace
}  // namespace topo::motion
