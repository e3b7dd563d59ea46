// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/search.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

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

/// The best score of all cells and angle steps in the window, by trying each: the steps are those that the
/// points' reach asks for.
double best_of_all(const LikelihoodPyramid& pyramid, std::span<const Point> points, const types::Se2& centre,
                   const SearchWindow& window, const std::optional<Exclusion>& exclusion) {
  float reach = 1.0F;
  for (const Point& p : points) reach = std::max(reach, p.norm());
  const double cell = pyramid.cell_m(),
               step = std::max(cell / std::min(10.0, static_cast<double>(reach)), 0.004);
  const int half = static_cast<int>(std::ceil(window.half_m / cell));
  const int turns = static_cast<int>(std::ceil(window.half_rad / step));
  int best = 0;
  for (int turn = -turns; turn <= turns; ++turn) {
    const types::Se2 turned{centre.x_m, centre.y_m, centre.theta_rad + turn * step};
    std::vector<CellOffset> cells;
    for (const Point& p : points) {
      const types::Vector2 at = turned * types::Vector2(p.cast<double>()) - pyramid.origin().cast<double>();
      cells.push_back(
          {static_cast<int>(std::floor(at.x() / cell)), static_cast<int>(std::floor(at.y() / cell))});
    }
    for (int y = -half; y <= half; ++y) {
      for (int x = -half; x <= half; ++x) {
        const types::Se2 pose{centre.x_m + x * cell, centre.y_m + y * cell, turned.theta_rad};
        if (exclusion && distance_m(pose, exclusion->centre) < exclusion->radius_m &&
            std::abs(types::wrap_angle(pose.theta_rad - exclusion->centre.theta_rad)) < exclusion->radius_rad)
          continue;
        int score = 0;
        for (const CellOffset& c : cells) score += pyramid.at(0, c.x + x, c.y + y);
        best = std::max(best, score);
      }
    }
  }
  return best / (255.0 * static_cast<double>(points.size()));
}

TEST(Search, FindsTheBestOfAllPosesThatAreNotExcluded) {
  std::mt19937 random(8);
  const mocks::FlatWorld world = mocks::two_rooms();
  const SurfelMap map = testing::map_of(world, {{3.0, 3.0, 0.0}, {9.0, 4.0, 2.0}}, 0.01, random);
  const LikelihoodPyramid pyramid(map, kSearchParams);
  for (int k = 0; k < 12; ++k) {
    const types::Se2 truth{2.0 + 0.5 * k, 2.5, 0.3 * k};
    std::vector<Point> points = testing::view_of(world, truth, 0.02, random).points;
    points.resize(std::min<std::size_t>(points.size(), 60));
    const double off_m = k % 3 == 0 ? -0.55 : 0.2;  // within the window, or beyond its upper right corner
    const types::Se2 centre{truth.x_m + off_m, truth.y_m + off_m, truth.theta_rad + 0.05};
    const SearchWindow window{0.4, 0.12};
    std::optional<Exclusion> exclusion;
    if (k % 2 == 1) exclusion = Exclusion{truth, 0.3, 0.1};
    const auto hit = search(pyramid, points, centre, window, 0.05, kSearchParams, exclusion);
    ASSERT_TRUE(hit) << k;
    EXPECT_NEAR(hit->score, best_of_all(pyramid, points, centre, window, exclusion), 1e-12) << k;
    EXPECT_LE(std::abs(hit->T_map_base.x_m - centre.x_m), window.half_m + 1e-9);
    EXPECT_LE(std::abs(hit->T_map_base.y_m - centre.y_m), window.half_m + 1e-9);
    if (exclusion) {
      EXPECT_TRUE(distance_m(hit->T_map_base, truth) >= 0.3 - 1e-9 ||
                  std::abs(types::wrap_angle(hit->T_map_base.theta_rad - truth.theta_rad)) >= 0.1 - 1e-9);
    }
    EXPECT_FALSE(search(pyramid, points, centre, window, hit->score + 0.01, kSearchParams, exclusion));
    EXPECT_TRUE(search(pyramid, points, centre, window, hit->score - 0.01, kSearchParams, exclusion));
  }
}

}  // namespace
}  // namespace topo::slam
