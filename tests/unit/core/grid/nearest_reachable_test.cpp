// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/grid/nearest_reachable.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>
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

TEST(NearestReachable, OfEquallyNearCellsTheCheapestIsTaken) {
  for (int cheapest = 0; cheapest < 4; ++cheapest) {
    const DenseMap map = filled_map(9, 9, CellState::kFree);
    const CellIndex goal{4, 4};
    const std::array<CellIndex, 4> around{{{6, 4}, {4, 6}, {2, 4}, {4, 2}}};
    TravelField field;
    field.cost_m.assign(map.cells.size(), std::numeric_limits<float>::infinity());
    for (int i = 0; i < 4; ++i)
      field.cost_m[map.index(around[static_cast<std::size_t>(i)])] = i == cheapest ? 3.0F : 5.0F;
    EXPECT_EQ(nearest_reachable(map, field, goal, 1.0), around[static_cast<std::size_t>(cheapest)]);
    EXPECT_EQ(nearest_to_stay_at(map, field, goal, 1.0), around[static_cast<std::size_t>(cheapest)]);
    EXPECT_FALSE(nearest_reachable(map, field, goal, 0.09)) << "two cells away";
    EXPECT_TRUE(nearest_reachable(map, field, goal, 0.11));
  }
}

TEST(NearestReachable, AReachableGoalIsItsOwnNearest) {
  const DenseMap map = filled_map(30, 30, CellState::kFree);
  const TravelField field = field_from(map, {15, 15});
  for (const CellIndex goal : {CellIndex{15, 15}, {10, 12}, {20, 9}}) {
    EXPECT_EQ(nearest_reachable(map, field, goal, 0.0), goal);
    EXPECT_EQ(nearest_to_stay_at(map, field, goal, 3.0), goal);
  }
}

}  // namespace
}  // namespace topo::grid
