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
  const auto path = smooth_path(map, clearance, grid::route_to(map, field, {100, 60}), 0.6);
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
    const auto path = smooth_path(map, clearance, route, rules.preferred_m);
    RC_ASSERT((path.front() - map.centre_of(start)).norm() < 1e-9);
    RC_ASSERT((path.back() - map.centre_of(goal)).norm() < 1e-9);
    for (std::size_t i = 1; i < path.size(); ++i) {
      RC_ASSERT((path[i] - path[i - 1]).norm() <= 0.16);
      RC_ASSERT(static_cast<double>(clearance[map.index(map.cell_at(path[i]))]) >= rules.radius_m - 0.071);
    }
  });
  EXPECT_TRUE(held);
}

}  // namespace
}  // namespace topo::travel
