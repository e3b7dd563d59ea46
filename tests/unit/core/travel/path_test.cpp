// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/travel/path.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "core/grid/distance.hpp"
#include "core/grid/wavefront.hpp"
#include "tests/unit/core/travel/drawn_map.hpp"

namespace topo::travel {
namespace {

using types::Vector2;

/// Free space of 6 x 6 m with boxes in it, within walls.
grid::DenseMap cluttered_map(const std::vector<std::pair<int, int>>& boxes) {
  constexpr int kSide = 120;
  std::vector<std::string> rows(kSide, std::string(kSide, '.'));
  for (int i = 0; i < kSide; ++i) {
    const auto k = static_cast<std::size_t>(i);
    rows[k].front() = rows[k].back() = rows.front()[k] = rows.back()[k] = '#';
  }
  for (const auto& [x, y] : boxes) {
    for (int i = 0; i < 36; ++i)
      rows[static_cast<std::size_t>(y + i / 6)][static_cast<std::size_t>(x + i % 6)] = '#';
  }
  return drawn_map(rows);
}

TEST(SmoothPath, aStraightWayIsStraight) {
  const grid::DenseMap map = cluttered_map({});
  const auto clearance = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
  const auto field = grid::travel_field(map, clearance, {20, 20}, {});
  const auto path = smooth_path(map, clearance, grid::route_to(map, field, {100, 60}), 0.6, {});
  ASSERT_GT(path.size(), 2U);
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length_m += (path[i] - path[i - 1]).norm();
  EXPECT_NEAR(length_m, (map.centre_of({100, 60}) - map.centre_of({20, 20})).norm(), 0.05);
}

TEST(SmoothPath, keepsItsEndsItsSpacingAndTheRobotsWidth) {
  const bool held = rc::check("smooth_path", [] {
    const auto boxes = *rc::gen::container<std::vector<std::pair<int, int>>>(
        6, rc::gen::pair(rc::gen::inRange(15, 100), rc::gen::inRange(15, 100)));
    const grid::DenseMap map = cluttered_map(boxes);
    const auto clearance = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
    const grid::TravelRules rules;
    const grid::CellIndex start{10, 10}, goal{108, 108};
    const auto field = grid::travel_field(map, clearance, start, rules);
    const auto route = grid::route_to(map, field, goal);
    if (route.empty()) return;
    const auto path = smooth_path(map, clearance, route, rules.preferred_m, {});
    RC_ASSERT((path.front() - map.centre_of(start)).norm() < 1e-9);
    RC_ASSERT((path.back() - map.centre_of(goal)).norm() < 1e-9);
    for (std::size_t i = 1; i < path.size(); ++i) {
      RC_ASSERT((path[i] - path[i - 1]).norm() <= 0.16);
      RC_ASSERT(static_cast<double>(clearance[map.index(map.cell_at(path[i]))]) >= rules.radius_m - 0.071);
    }
  });
  EXPECT_TRUE(held);
}

TEST(SmoothPath, OfNoCellAndOfOneIsThatCell) {
  const grid::DenseMap map = cluttered_map({});
  const auto clearance = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
  EXPECT_TRUE(smooth_path(map, clearance, {}, 0.6, {}).empty());
  const std::vector<grid::CellIndex> one{{30, 40}}, two{{30, 40}, {31, 41}};
  EXPECT_EQ(smooth_path(map, clearance, one, 0.6, {}), std::vector<Vector2>{map.centre_of({30, 40})});
  EXPECT_EQ(smooth_path(map, clearance, two, 0.6, {}),
            (std::vector<Vector2>{map.centre_of({30, 40}), map.centre_of({31, 41})}));
}

TEST(SmoothPath, IsNoLongerThanTheCellsAndGoesAlongWithTheMap) {
  EXPECT_TRUE(rc::check([] {
    const auto boxes = *rc::gen::container<std::vector<std::pair<int, int>>>(
        5, rc::gen::pair(rc::gen::inRange(15, 100), rc::gen::inRange(15, 100)));
    grid::DenseMap map = cluttered_map(boxes);
    const auto clearance = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
    auto route = grid::route_to(map, grid::travel_field(map, clearance, {10, 10}, {}), {108, 60});
    if (route.empty()) return;
    const auto path = smooth_path(map, clearance, route, 0.72, {});
    double path_m = 0.0, route_m = 0.0;
    for (std::size_t i = 1; i < path.size(); ++i) path_m += (path[i] - path[i - 1]).norm();
    for (std::size_t i = 1; i < route.size(); ++i)
      route_m += (map.centre_of(route[i]) - map.centre_of(route[i - 1])).norm();
    RC_ASSERT(path_m <= route_m + 1e-9);
    // A whole number of 64 cells on, the numbers are others by rounding only.
    map.box = {{64, -128}, {map.box.max.x + 64, map.box.max.y - 128}};
    for (grid::CellIndex& cell : route) cell = {cell.x + 64, cell.y - 128};
    const auto moved = smooth_path(map, clearance, route, 0.72, {});
    RC_ASSERT((moved.front() - path.front() - Vector2(3.2, -6.4)).norm() < 1e-9);
    RC_ASSERT((moved.back() - path.back() - Vector2(3.2, -6.4)).norm() < 1e-9);
  }));
}

TEST(SmoothPath, HasPointsAsFarApartAsItsParametersSay) {
  const grid::DenseMap map = cluttered_map({});
  const auto clearance = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
  const auto route = grid::route_to(map, grid::travel_field(map, clearance, {10, 10}, {}), {100, 10});
  ASSERT_FALSE(route.empty());
  PathParams wide;
  wide.spacing_m = 0.4;
  const std::size_t usual = smooth_path(map, clearance, route, 0.6, {}).size();
  const std::size_t fewer = smooth_path(map, clearance, route, 0.6, wide).size();
  EXPECT_GT(usual, 3 * fewer);
}

TEST(NearestPoint, IsTheFirstNearestOfTheNextThreeMetres) {
  EXPECT_TRUE(rc::check([] {
    const auto any_m = [] { return 0.1 * *rc::gen::inRange(-30, 30); };
    std::vector<Vector2> path(*rc::gen::inRange<std::size_t>(0, 60));
    for (Vector2& p : path) p = {any_m(), any_m()};
    const Vector2 here{any_m(), any_m()};
    const std::size_t nearest = nearest_point(path, here, {});
    RC_ASSERT(nearest <= path.size());
    for (std::size_t i = 0; i < std::min(path.size(), PathParams{}.near_points); ++i) {
      RC_ASSERT((path[nearest] - here).squaredNorm() <= (path[i] - here).squaredNorm());
      if (i < nearest) RC_ASSERT((path[i] - here).squaredNorm() > (path[nearest] - here).squaredNorm());
    }
    RC_ASSERT((nearest < PathParams{}.near_points || nearest == 0));
  }));
  EXPECT_EQ(nearest_point({}, {1.0, 1.0}, {}), 0U);
}

}  // namespace
}  // namespace topo::travel
