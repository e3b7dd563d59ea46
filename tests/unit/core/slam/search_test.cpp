// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/search.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "tests/unit/core/slam/matching_fixture.hpp"

namespace topo::slam {
namespace {

const SearchParams kSearchParams;

TEST(LikelihoodPyramid, EveryLevelBoundsTheCellsAboveIt) {
  std::mt19937 random(3);
  const SurfelMap map = testing::map_of(mocks::two_rooms(), {{3.0, 3.0, 0.0}}, 0.0, random);
  const LikelihoodPyramid pyramid(map, kSearchParams);
  EXPECT_TRUE(rc::check("at(h, x, y) is the maximum over its square, inside, at the border and outside", [&] {
    const int level = *rc::gen::inRange(0, pyramid.depth() + 1);
    const int x = *rc::gen::inRange(-40, 1040), y = *rc::gen::inRange(-40, 1040);
    int best = 0;
    for (int dy = 0; dy < 1 << level; ++dy) {
      for (int dx = 0; dx < 1 << level; ++dx) best = std::max<int>(best, pyramid.at(0, x + dx, y + dy));
    }
    RC_ASSERT(pyramid.at(level, x, y) >= best);
    if (x >= 0 && y >= 0) RC_ASSERT(pyramid.at(level, x, y) == best);
  }));
}

TEST(Search, FindsAPoseMetresAndDegreesAway) {
  std::mt19937 random(4);
  const mocks::FlatWorld world = mocks::two_rooms();
  const SurfelMap map =
      testing::map_of(world, {{3.0, 3.0, 0.0}, {5.5, 3.5, 0.5}, {9.0, 4.0, 2.0}}, 0.01, random);
  const LikelihoodPyramid pyramid(map, kSearchParams);
  const types::Se2 truth{4.0, 2.5, 0.7};
  const testing::View view = testing::view_of(world, truth, 0.01, random);
  const auto hit = search(pyramid, view.points, {5.2, 3.4, 0.3}, {2.0, 0.6}, 0.3, kSearchParams);
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR(hit->T_map_base.x_m, truth.x_m, 0.06);
  EXPECT_NEAR(hit->T_map_base.y_m, truth.y_m, 0.06);
  EXPECT_NEAR(hit->T_map_base.theta_rad, truth.theta_rad, 0.02);
  EXPECT_GT(hit->score, 0.7);
}

/// Branch and bound must not lose the best pose: a search without depth tries every cell.
TEST(Search, EqualsTryingEveryPose) {
  std::mt19937 random(5);
  const mocks::FlatWorld world = mocks::two_rooms();
  const SurfelMap map = testing::map_of(world, {{3.0, 3.0, 0.0}}, 0.0, random);
  SearchParams flat = kSearchParams;
  flat.depth = 0;
  const LikelihoodPyramid deep(map, kSearchParams), shallow(map, flat);
  for (int i = 0; i < 5; ++i) {
    const types::Se2 truth{3.0 + 0.2 * i, 3.0 - 0.1 * i, 0.1 * i};
    const testing::View view = testing::view_of(world, truth, 0.02, random);
    const auto a = search(deep, view.points, {3.2, 2.9, 0.1}, {0.8, 0.3}, 0.1, kSearchParams);
    const auto b = search(shallow, view.points, {3.2, 2.9, 0.1}, {0.8, 0.3}, 0.1, flat);
    ASSERT_TRUE(a && b);
    EXPECT_DOUBLE_EQ(a->score, b->score);
  }
}

TEST(Search, AnExclusionShowsTheSecondPeak) {
  std::mt19937 random(6);
  // Two equal niches 2 m apart: the place along the wall is ambiguous.
  mocks::FlatWorld world;
  for (int i = 0; i < 8; ++i) {
    const double x = 2.0 * i;
    world.walls.push_back({{x, 0.0}, {x + 1.0, 0.0}});
    world.walls.push_back({{x + 1.0, 0.0}, {x + 1.0, 0.5}});
    world.walls.push_back({{x + 1.0, 0.5}, {x + 2.0, 0.5}});
    world.walls.push_back({{x + 2.0, 0.5}, {x + 2.0, 0.0}});
  }
  const SurfelMap map = testing::map_of(world, {{8.0, -3.0, 1.57}}, 0.0, random);
  const LikelihoodPyramid pyramid(map, kSearchParams);
  const testing::View view = testing::view_of(world, {8.0, -3.0, 1.57}, 0.0, random);
  const auto best = search(pyramid, view.points, {8.0, -3.0, 1.57}, {3.0, 0.1}, 0.2, kSearchParams);
  ASSERT_TRUE(best.has_value());
  const auto second = search(pyramid, view.points, {8.0, -3.0, 1.57}, {3.0, 0.1}, 0.2, kSearchParams,
                             Exclusion{best->T_map_base, 0.6, 0.3});
  ASSERT_TRUE(second.has_value());
  EXPECT_GT(second->score, 0.6 * best->score);
  EXPECT_GT(std::abs(second->T_map_base.x_m - best->T_map_base.x_m), 0.6 - 0.06);
}

TEST(Search, NothingWhenNothingScoresEnough) {
  std::mt19937 random(6);
  const SurfelMap map = testing::map_of(mocks::two_rooms(), {{3.0, 3.0, 0.0}}, 0.0, random);
  const LikelihoodPyramid pyramid(map, kSearchParams);
  EXPECT_FALSE(
      search(pyramid, std::vector<Point>{{30.0F, 30.0F}}, {}, {0.5, 0.1}, 0.3, kSearchParams).has_value());
  EXPECT_FALSE(search(pyramid, {}, {}, {0.5, 0.1}, 0.3, kSearchParams).has_value());
}

}  // namespace
}  // namespace topo::slam
