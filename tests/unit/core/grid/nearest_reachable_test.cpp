// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/grid/nearest_reachable.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <cstdint>

#include "core/grid/distance.hpp"
#include "tests/unit/core/grid/maps.hpp"

namespace topo::grid {
namespace {

const TravelRules kThinRobot{.radius_m = 0.1, .tight_m = 0.06, .preferred_m = 0.2, .start_m = 0.1};

TEST(NearestReachable, IsTheNearestWithinTheLimitAndSoIsTheNearestToStayAt) {
  EXPECT_TRUE(rc::check("nearest", [] {
    const DenseMap map = random_map(40);
    const auto clearance = clearance_m(map, Boundary::kOccupiedOrUnknown);
    const auto start = *rc::gen::inRange<std::size_t>(0, map.cells.size());
    const TravelField field = travel_field(map, clearance, map.cell(start), kThinRobot);
    const CellIndex goal{*rc::gen::inRange(-10, 50), *rc::gen::inRange(-10, 50)};
    const double within_m = 0.05 * *rc::gen::inRange(0, 30);
    const auto away_m = [&](CellIndex c) { return std::hypot(c.x - goal.x, c.y - goal.y) * 0.05; };
    double reached_m = HUGE_VAL, stayed_m = HUGE_VAL;
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      if (std::isinf(field.cost_m[i])) continue;
      reached_m = std::min(reached_m, away_m(map.cell(i)));
      if (clearance[i] >= 0.1F) stayed_m = std::min(stayed_m, away_m(map.cell(i)));
    }
    const auto reach = nearest_reachable(map, field, goal, within_m);
    const auto stay = nearest_to_stay_at(map, field, goal, within_m);
    RC_ASSERT(reach.has_value() == (reached_m <= within_m));
    RC_ASSERT(stay.has_value() == (stayed_m <= within_m));
    // Not `!reach || ...`: RC_ASSERT takes an expression apart, and evaluates both sides of it.
    if (reach) {
      RC_ASSERT(std::abs(away_m(*reach) - reached_m) < 1e-9);
      RC_ASSERT(!std::isinf(field.cost_m[map.index(*reach)]));
    }
    if (stay) {
      RC_ASSERT(std::abs(away_m(*stay) - stayed_m) < 1e-9);
      RC_ASSERT(field.can_stay_at(map.index(*stay)));
    }
  }));
}

TEST(NearestReachable, IsNoneInAnEmptyMapAndFarFromAny) {
  const DenseMap map = filled_map(20, 20, CellState::kFree);
  EXPECT_FALSE(nearest_reachable(DenseMap{}, TravelField{}, {0, 0}, 5.0));
  EXPECT_FALSE(nearest_reachable(map, field_from(map, {10, 10}), {INT32_MAX, INT32_MIN}, 5.0));
}

}  // namespace
}  // namespace topo::grid
