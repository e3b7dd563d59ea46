// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/greedy_cover.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

namespace topo::goals {
namespace {

std::vector<Prospect> prospects_of(const std::vector<double>& chances) {
  std::vector<Prospect> prospects;
  for (const double chance : chances) prospects.push_back({{0.0, 0.0}, {0, 0}, chance});
  return prospects;
}

StandingPlace own(std::uint32_t prospect, double x) { return {{x, 0.0}, {prospect}, 1.0, false}; }
StandingPlace shared(std::vector<std::uint32_t> prospects, double x, double away_m = 2.0) {
  return {{x, 0.0}, std::move(prospects), away_m, true};
}

TEST(GreedyCover, OnePlaceForAllThatItServes) {
  const auto prospects = prospects_of({0.5, 0.7, 0.6});
  const std::vector<StandingPlace> places = {own(0, 0.0), own(1, 4.0), own(2, 20.0), shared({0, 1}, 2.0)};
  const GreedyCover cover = cover_openings(prospects, places, {}, {});
  ASSERT_EQ(cover.chosen.size(), 2U);
  EXPECT_EQ(cover.chosen[0].place, 3U);
  EXPECT_EQ(cover.chosen[0].prospect, 1U) << "the likelier of the two";
  EXPECT_EQ(cover.chosen[1].place, 2U);
  EXPECT_EQ(cover.served, std::vector<bool>({true, true, true}));
}

TEST(GreedyCover, WhatIsHardlyWorthItAloneMayBeWithItsNeighbours) {
  const auto prospects = prospects_of({0.3, 0.3, 0.3});
  const std::vector<StandingPlace> alone = {own(0, 0.0), own(1, 4.0), own(2, 20.0)};
  const GreedyCover none = cover_openings(prospects, alone, {}, {});
  EXPECT_TRUE(none.chosen.empty());
  EXPECT_EQ(none.served, std::vector<bool>({false, false, false}));
  std::vector<StandingPlace> places = alone;
  places.push_back(shared({0, 1}, 2.0));
  const GreedyCover cover = cover_openings(prospects, places, {}, {});
  ASSERT_EQ(cover.chosen.size(), 1U);
  EXPECT_EQ(cover.chosen[0].place, 3U);
  EXPECT_FALSE(cover.served[2]);
}

TEST(GreedyCover, NobodyIsSentWhereARobotSawAllThatCanBeSeen) {
  const auto prospects = prospects_of({0.6, 0.7});
  const std::vector<StandingPlace> places = {own(0, 0.0), own(1, 4.0), shared({0, 1}, 2.0)};
  const std::vector<std::vector<types::Vector2>> visited = {{{2.0, 0.5}}};
  const GreedyCover cover = cover_openings(prospects, places, visited, {});
  ASSERT_EQ(cover.chosen.size(), 2U);
  EXPECT_EQ(cover.chosen[0].place, 1U);
  EXPECT_EQ(cover.chosen[1].place, 0U);
}

TEST(GreedyCover, OfPlacesAsGoodTheNearestIsChosen) {
  const auto prospects = prospects_of({0.5, 0.6, 0.7});
  const std::vector<StandingPlace> places = {shared({0, 1, 2}, 1.0, 2.0), shared({0, 1, 2}, 2.0, 1.5),
                                             shared({0, 1, 2}, 3.0, 1.8)};
  const GreedyCover cover = cover_openings(prospects, places, {}, {});
  ASSERT_EQ(cover.chosen.size(), 1U);
  EXPECT_EQ(cover.chosen[0].place, 1U);
}

TEST(GreedyCover, LeavesNothingThatWouldBeWorthIt) {
  EXPECT_TRUE(rc::check([] {
    std::vector<double> chances(static_cast<std::size_t>(*rc::gen::inRange(0, 12)));
    for (double& chance : chances) chance = 0.01 * *rc::gen::inRange(0, 100);
    const auto prospects = prospects_of(chances);
    std::vector<StandingPlace> places;
    for (std::uint32_t k = 0; k < chances.size(); ++k) places.push_back(own(k, k));
    const int more = chances.empty() ? 0 : *rc::gen::inRange(0, 20);
    for (int m = 0; m < more; ++m) {
      std::vector<std::uint32_t> serves;
      for (std::uint32_t k = 0; k < chances.size(); ++k)
        if (*rc::gen::inRange(0, 3) == 0) serves.push_back(k);
      places.push_back(shared(serves, 0.0));
    }
    const GoalParams params;
    const GreedyCover cover = cover_openings(prospects, places, {}, params);
    std::vector<bool> served(chances.size(), false);
    for (const Chosen& chosen : cover.chosen) {
      RC_ASSERT(!served[chosen.prospect]);
      for (const std::uint32_t k : places[chosen.place].serves) served[k] = true;
      RC_ASSERT(served[chosen.prospect]);
    }
    RC_ASSERT(served == cover.served);
    for (const StandingPlace& place : places) {
      double hope = 0.0;
      for (const std::uint32_t k : place.serves) hope += served[k] ? 0.0 : chances[k];
      RC_ASSERT(hope < params.worth_min + 1e-9);
    }
  }));
}

}  // namespace
}  // namespace topo::goals
