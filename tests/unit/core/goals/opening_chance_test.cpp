// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/opening_chance.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <numbers>

namespace topo::goals {
namespace {

constexpr double kHalfDisc_m2 = 2.0 * std::numbers::pi;  // of 2 m

TEST(OpeningChance, IsCertainForAHalfDiscThatNothingCloses) {
  EXPECT_DOUBLE_EQ(chance_to_lead_on({kHalfDisc_m2, 1.0}, 2.0), 1.0);
  EXPECT_DOUBLE_EQ(chance_to_lead_on({9.0 * kHalfDisc_m2, 1.0}, 2.0), 1.0) << "behind a wide opening";
}

TEST(OpeningChance, IsTheShareOfTheHalfDiscTimesThatOfItsOpenRim) {
  EXPECT_DOUBLE_EQ(chance_to_lead_on({0.5 * kHalfDisc_m2, 0.4}, 2.0), 0.2);
  EXPECT_DOUBLE_EQ(chance_to_lead_on({kHalfDisc_m2, 0.4}, 4.0), 0.1) << "a half disc of 4 m is four times it";
}

TEST(OpeningChance, IsNothingInAPocketAndWithoutUnknownSpace) {
  EXPECT_EQ(chance_to_lead_on({kHalfDisc_m2, 0.0}, 2.0), 0.0);
  EXPECT_EQ(chance_to_lead_on({0.0, 0.0}, 2.0), 0.0);
}

TEST(OpeningChance, IsAProbabilityThatNeverFallsWithTheSpace) {
  EXPECT_TRUE(rc::check([] {
    const SpaceBehind space{0.1 * *rc::gen::inRange(0, 300), 0.01 * *rc::gen::inRange(0, 101)};
    SpaceBehind more = space;
    more.area_m2 += 0.1 * *rc::gen::inRange(0, 100);
    more.ahead = std::min(1.0, more.ahead + 0.01 * *rc::gen::inRange(0, 50));
    const double chance = chance_to_lead_on(space, 2.4);
    RC_ASSERT(chance >= 0.0 && chance <= 1.0);
    RC_ASSERT(chance_to_lead_on(more, 2.4) >= chance);
  }));
}

}  // namespace
}  // namespace topo::goals
