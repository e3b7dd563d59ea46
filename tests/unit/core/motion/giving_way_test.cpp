// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/motion/giving_way.hpp"

#include <gtest/gtest.h>

#include <array>

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
  return giving_way_scale(twist, std::array{one}, kAlive_s, p3dx());
}

TEST(GivingWay, NothingMovesNothingSlows) {
  EXPECT_EQ(giving_way_scale({0.7, 0.0}, {}, kAlive_s, p3dx()), 1.0);
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
    RC_ASSERT(s == 0.0 || stands_in_time(given, std::array{one}, kAlive_s, p3dx().margin_m, p3dx()));
  }));
}

}  // namespace
}  // namespace topo::motion
