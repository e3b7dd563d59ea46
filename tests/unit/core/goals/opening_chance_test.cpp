// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/opening_chance.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

#include "core/types/se2.hpp"
#include "tests/unit/core/goals/scene.hpp"

namespace topo::goals {
namespace {

TEST(OpeningChance, IsEvenForTwoMetresAtNineAndAHalf) {
  EXPECT_NEAR(chance_to_lead_on(2.0, 9.5, {}), 0.5, 0.01);
}

TEST(OpeningChance, GrowsWithWidthAndWithTheWayFromThePaths) {
  EXPECT_GT(chance_to_lead_on(2.0, 5.0, {}), chance_to_lead_on(1.0, 5.0, {}));
  EXPECT_GT(chance_to_lead_on(1.0, 5.0, {}), chance_to_lead_on(1.0, 2.0, {}));
  EXPECT_LT(chance_to_lead_on(0.9, 1.0, {}), 0.05) << "the shadow of something that a robot passed";
}

TEST(OpeningChance, IsOneOfManyWhereNobodyWasAtAll) {
  const double chance = chance_to_lead_on(1.0, HUGE_VAL, {});
  EXPECT_GT(chance, 0.3);
  EXPECT_LT(chance, 1.0);
  EXPECT_EQ(chance, chance_to_lead_on(1.0, 50.0, {}));
}

TEST(OpeningChance, TheNearestPoseOfAnyPathCounts) {
  const std::vector<std::vector<types::Vector2>> paths = {{{0.0, 0.0}, {4.0, 0.0}}, {}, {{9.0, 3.0}}};
  EXPECT_DOUBLE_EQ(distance_from_paths_m({6.0, 0.0}, paths), 2.0);
  EXPECT_DOUBLE_EQ(distance_from_paths_m({9.0, 4.0}, paths), 1.0);
  EXPECT_EQ(distance_from_paths_m({9.0, 4.0}, {}), HUGE_VAL);
}

double odds(double opening_m, double from_paths_m) {
  const double chance = chance_to_lead_on(opening_m, from_paths_m, {});
  return chance / (1.0 - chance);
}

TEST(OpeningChance, OddsGrowAsTheWidthAndThePowerOfTheDistance) {
  EXPECT_TRUE(rc::check([] {
    const double opening_m = 0.05 * *rc::gen::inRange(1, 200), far_m = 0.01 * *rc::gen::inRange(1, 250);
    RC_ASSERT(std::abs(odds(3.0 * opening_m, far_m) / odds(opening_m, far_m) - 3.0) < 1e-9);
    // Half a metre is added to the distance: four times as far then is eight times as likely.
    const double farther_m = 4.0 * (far_m + 0.5) - 0.5;
    RC_ASSERT(std::abs(odds(opening_m, farther_m) / odds(opening_m, far_m) - 8.0) < 1e-9);
  }));
}

TEST(OpeningChance, IsEvenWhereTheParameterPutsIt) {
  const ChanceParams linear{.far_m = 12.0, .near_m = 0.0, .power = 1.0, .even_at = 20.0};
  EXPECT_DOUBLE_EQ(chance_to_lead_on(2.0, 10.0, linear), 0.5);
  EXPECT_DOUBLE_EQ(chance_to_lead_on(2.0, 90.0, linear), 1.2 / 2.2) << "as far as 12 m";
}

TEST(OpeningChance, IsAProbabilityThatNeverFalls) {
  EXPECT_TRUE(rc::check([] {
    const double opening_m = 0.05 * *rc::gen::inRange(0, 200), far_m = 0.01 * *rc::gen::inRange(0, 3000);
    const double more_m = 0.01 * *rc::gen::inRange(0, 500);
    const double chance = chance_to_lead_on(opening_m, far_m, {});
    RC_ASSERT(chance >= 0.0 && chance < 1.0);
    RC_ASSERT(chance_to_lead_on(opening_m + more_m, far_m, {}) >= chance);
    RC_ASSERT(chance_to_lead_on(opening_m, far_m + more_m, {}) >= chance);
  }));
}

TEST(OpeningChance, TheDistanceFromPathsIsTheSameHoweverTheMapIsTurned) {
  EXPECT_TRUE(rc::check([] {
    auto paths = random_paths(9.0);
    const types::Vector2 p = random_point(9.0);
    double nearest_m = HUGE_VAL;
    for (const auto& path : paths)
      for (const types::Vector2& pose : path) nearest_m = std::min(nearest_m, (pose - p).norm());
    const types::Se2 motion{3.0, -2.0, 0.01 * *rc::gen::inRange(-314, 314)};
    const double away_m = distance_from_paths_m(p, paths);
    for (auto& path : paths)
      for (types::Vector2& pose : path) pose = motion * pose;
    std::ranges::reverse(paths);
    const double moved_m = distance_from_paths_m(motion * p, paths);
    if (std::isinf(nearest_m)) {
      RC_ASSERT(away_m == HUGE_VAL && moved_m == HUGE_VAL);
    } else {
      RC_ASSERT(std::abs(away_m - nearest_m) < 1e-9 && std::abs(moved_m - away_m) < 1e-9);
    }
  }));
}

}  // namespace
}  // namespace topo::goals
