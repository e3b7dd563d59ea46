// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/opening_check.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "core/goals/frontiers.hpp"
#include "tests/unit/core/goals/scene.hpp"

namespace topo::goals {
namespace {

using grid::CellState;
using places::DrawnMap;

bool leads_on(const grid::DenseMap& map, const GoalParams& params) {
  const auto frontiers = find_frontiers(map, 0.0);
  return std::ranges::any_of(frontiers,
                             [&](const Frontier& f) { return leads_to_unknown(map, f.cells, params); });
}

GoalParams for_a_point() {
  GoalParams params;
  params.robot_radius_m = 0.01;
  return params;
}

TEST(OpeningCheck, APocketLeadsOnIfDeepEnoughAndLargeEnough) {
  EXPECT_TRUE(rc::check([] {
    const int width = *rc::gen::inRange(1, 40), depth = *rc::gen::inRange(1, 40);
    GoalParams params = for_a_point();
    const int least_depth = *rc::gen::inRange(1, 40), least_cells = *rc::gen::inRange(1, 900);
    params.behind_m = 0.05 * least_depth;
    params.behind_m2 = 0.0025 * (least_cells - 0.5);
    const int looked = *rc::gen::inRange(0, 60);
    params.look_m = 0.05 * looked;
    const int counted = std::min(depth, std::max(least_depth, looked));
    const bool expected = depth >= least_depth && width * counted >= least_cells;
    RC_ASSERT(leads_on(room_with_pocket(width, depth), params) == expected);
  }));
}

/// A room of 3.5 x 9 m behind its narrow side: 2.4 m of depth have less than the 10 m2 that are asked for.
TEST(OpeningCheck, AreaIsCountedAsDeepAsIsAskedFor) {
  GoalParams params = for_a_point();
  params.behind_m2 = 10.0;
  EXPECT_FALSE(leads_on(room_with_pocket(70, 180), params));
  params.look_m = 6.0;
  EXPECT_TRUE(leads_on(room_with_pocket(70, 180), params));
  EXPECT_FALSE(leads_on(room_with_pocket(70, 50), params)) << "8.75 m2";
}

TEST(OpeningCheck, TheRobotsDiscHasToGetThrough) {
  for (int gap = 2; gap <= 30; ++gap) {
    // A wall across the unknown space behind the room, with a gap in its middle.
    DrawnMap drawn(80, 160);
    drawn.free(7, 7, 67, 27).occupied(5, 5, 67, 7).occupied(5, 5, 7, 160).occupied(67, 5, 69, 160);
    drawn.occupied(7, 35, 30, 36).occupied(30 + gap, 35, 67, 36);
    GoalParams params;
    // Between the centres of the wall's last cells on both sides are gap + 1 cells.
    const bool fits = 0.05 * (gap + 1) > 2.0 * params.robot_radius_m + 0.05;
    const bool sticks = 0.05 * (gap + 1) < 2.0 * params.robot_radius_m - 0.05;
    if (!fits && !sticks) continue;
    EXPECT_EQ(leads_on(drawn.map(), params), fits) << gap << " cells";
  }
}

TEST(OpeningCheck, ASmallerDemandIsMetWhereAGreaterOneIs) {
  EXPECT_TRUE(rc::check([] {
    const grid::DenseMap map = random_room(60);
    GoalParams params;
    params.behind_m = 0.05 * *rc::gen::inRange(1, 30);
    params.behind_m2 = 0.05 * *rc::gen::inRange(1, 60);
    GoalParams modest = params;
    modest.behind_m2 *= 0.01 * *rc::gen::inRange(10, 101);
    for (const Frontier& f : find_frontiers(map, 0.0))
      if (leads_to_unknown(map, f.cells, params)) RC_ASSERT(leads_to_unknown(map, f.cells, modest));
  }));
}

TEST(OpeningCheck, FreeSpaceBehindAFrontierDoesNotCount) {
  // A strip of unknown cells, of which one alone is a step into the unknown.
  const grid::DenseMap map =
      DrawnMap(60, 60).room(10, 10, 50, 50).fill(10, 30, 50, 31, CellState::kUnknown).map();
  GoalParams params = for_a_point();
  params.behind_m = 0.1;
  params.behind_m2 = 0.01;
  EXPECT_FALSE(leads_on(map, params)) << "0.1 m2 of it, but nowhere 0.1 m deep";
  params.behind_m = 0.05;
  EXPECT_TRUE(leads_on(map, params));
}

TEST(OpeningCheck, NothingLeadsOnFromNoCells) {
  EXPECT_FALSE(leads_to_unknown(DrawnMap(30, 30).free(5, 5, 25, 25).map(), {}, {}));
}

}  // namespace
}  // namespace topo::goals
