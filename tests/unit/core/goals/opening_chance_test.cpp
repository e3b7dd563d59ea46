// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/opening_chance.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace topo::goals {
namespace {

TEST(OpeningChance, IsEvenForTwoMetresAtNineAndAHalf) { EXPECT_NEAR(chance_to_lead_on(2.0, 9.5), 0.5, 0.01); }

TEST(OpeningChance, GrowsWithWidthAndWithTheWayFromThePaths) {
  EXPECT_GT(chance_to_lead_on(2.0, 5.0), chance_to_lead_on(1.0, 5.0));
  EXPECT_GT(chance_to_lead_on(1.0, 5.0), chance_to_lead_on(1.0, 2.0));
  EXPECT_LT(chance_to_lead_on(0.9, 1.0), 0.05) << "the shadow of something that a robot passed";
}

TEST(OpeningChance, IsOneOfManyWhereNobodyWasAtAll) {
  const double chance = chance_to_lead_on(1.0, HUGE_VAL);
  EXPECT_GT(chance, 0.3);
  EXPECT_LT(chance, 1.0);
  EXPECT_EQ(chance, chance_to_lead_on(1.0, 50.0));
}

TEST(OpeningChance, TheNearestPoseOfAnyPathCounts) {
  const std::vector<std::vector<types::Vector2>> paths = {{{0.0, 0.0}, {4.0, 0.0}}, {}, {{9.0, 3.0}}};
  EXPECT_DOUBLE_EQ(distance_from_paths_m({6.0, 0.0}, paths), 2.0);
  EXPECT_DOUBLE_EQ(distance_from_paths_m({9.0, 4.0}, paths), 1.0);
  EXPECT_EQ(distance_from_paths_m({9.0, 4.0}, {}), HUGE_VAL);
}

}  // namespace
}  // namespace topo::goals
