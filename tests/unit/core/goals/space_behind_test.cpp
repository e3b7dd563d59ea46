// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/space_behind.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "core/goals/frontiers.hpp"
#include "tests/unit/core/goals/scene.hpp"

namespace topo::goals {
namespace {

using grid::CellState;
using places::DrawnMap;

constexpr double kCell_m = 0.05, kCell_m2 = kCell_m * kCell_m;

/// A room, and behind its whole upper side a pocket of unknown space with walls around it.
grid::DenseMap room_with_pocket(int width, int depth) {
  DrawnMap drawn(width + 20, depth + 40);
  drawn.occupied(5, 5, width + 9, depth + 29).free(7, 7, width + 7, 27);
  return drawn.fill(7, 27, width + 7, 27 + depth, CellState::kUnknown).map();
}

SpaceBehind behind_only_frontier(const grid::DenseMap& map, std::span<const types::Segment> continued,
                                 double reach_m) {
  const auto frontiers = find_frontiers(map, 0.0);
  EXPECT_EQ(frontiers.size(), 1U);
  return space_behind(map, frontiers.at(0).cells, continued, reach_m);
}

TEST(SpaceBehind, OfAPocketIsItsAreaAndNothingAhead) {
  EXPECT_TRUE(rc::check([] {
    const int width = *rc::gen::inRange(1, 40), depth = *rc::gen::inRange(1, 40);
    const SpaceBehind space =
        behind_only_frontier(room_with_pocket(width, depth), {}, kCell_m * *rc::gen::inRange(depth, 60));
    RC_ASSERT(std::abs(space.area_m2 - width * depth * kCell_m2) < 1e-9);
    RC_ASSERT(space.ahead == 0.0);
  }));
}

TEST(SpaceBehind, OfAPassageIsAsDeepAsIsLookedAndItsEndIsAhead) {
  EXPECT_TRUE(rc::check([] {
    const int width = *rc::gen::inRange(1, 40), reach = *rc::gen::inRange(1, 40);
    const SpaceBehind space = behind_only_frontier(room_with_pocket(width, reach + 1), {}, kCell_m * reach);
    RC_ASSERT(std::abs(space.area_m2 - width * reach * kCell_m2) < 1e-9);
    RC_ASSERT(std::abs(space.ahead - width / (width + 2.0 * reach)) < 1e-9);  // beside its two walls
  }));
}

TEST(SpaceBehind, EndsAtAContinuedWallHoweverItLies) {
  EXPECT_TRUE(rc::check([] {
    const int width = *rc::gen::inRange(2, 40), depth = *rc::gen::inRange(4, 40);
    const grid::DenseMap map = room_with_pocket(width, depth);
    // Across the pocket, from one of its walls to the other; the ends lie in the walls or outside the map.
    const double from_y = 27.0 + *rc::gen::inRange(0, depth), to_y = 27.0 + *rc::gen::inRange(0, depth);
    const int beyond = *rc::gen::inRange(0, 200);
    const types::Vector2 a = map.centre_of({6, 0}), b = map.centre_of({width + 7, 0});
    const double tilt = (to_y - from_y) / (b.x() - a.x()) * kCell_m;
    types::Segment wall{{a.x(), map.centre_of({0, 0}).y() + from_y * kCell_m},
                        {b.x(), map.centre_of({0, 0}).y() + to_y * kCell_m}};
    wall.a -= beyond * kCell_m * types::Vector2(1.0, tilt);
    wall.b += beyond * kCell_m * types::Vector2(1.0, tilt);
    if (*rc::gen::arbitrary<bool>()) std::swap(wall.a, wall.b);
    const std::vector<types::Segment> continued{wall};
    const SpaceBehind space = behind_only_frontier(map, continued, kCell_m * 60);
    int before = 0;  // cells of the pocket before the wall
    for (int x = 7; x < width + 7; ++x)
      before += static_cast<int>(from_y + (to_y - from_y) * (x - 6.0) / (width + 1.0)) - 27;
    RC_ASSERT(space.ahead == 0.0);
    RC_ASSERT(space.area_m2 <= (before + width + 1) * kCell_m2 + 1e-9);
    RC_ASSERT(space.area_m2 >= (before - width - 1) * kCell_m2 - 1e-9);
  }));
}

TEST(SpaceBehind, AWallThatDoesNotReachAcrossLeavesAWayAround) {
  const grid::DenseMap map = room_with_pocket(40, 40);
  const std::vector<types::Segment> half{{map.centre_of({6, 37}), map.centre_of({30, 37})}};
  EXPECT_NEAR(behind_only_frontier(map, half, 4.0).area_m2, (1600 - 24) * kCell_m2, 1e-9);
  const std::vector<types::Segment> point{{map.centre_of({20, 37}), map.centre_of({20, 37})}};
  EXPECT_NEAR(behind_only_frontier(map, point, 4.0).area_m2, (1600 - 1) * kCell_m2, 1e-9);
}

TEST(SpaceBehind, GoesOnBeyondTheMap) {
  const DrawnMap drawn = DrawnMap(40, 40).free(0, 0, 40, 40);
  const auto frontiers = find_frontiers(drawn.map(), 0.0);
  ASSERT_EQ(frontiers.size(), 1U);
  const SpaceBehind space = space_behind(drawn.map(), frontiers[0].cells, {}, 1.0);
  EXPECT_EQ(space.ahead, 1.0);
  EXPECT_NEAR(space.area_m2, 4 * 2.0 * 1.0 + 3.14 * 1.0, 0.4)
      << "sides, and quarters of a disc at the corners";
}

TEST(SpaceBehind, OfNoOpeningIsNone) {
  const SpaceBehind space = space_behind(DrawnMap(30, 30).free(5, 5, 25, 25).map(), {}, {}, 2.4);
  EXPECT_EQ(space.area_m2, 0.0);
  EXPECT_EQ(space.ahead, 0.0);
}

/// Whatever the map: only unknown cells within reach count, each once.
TEST(SpaceBehind, CountsUnknownCellsWithinReachOnce) {
  EXPECT_TRUE(rc::check([] {
    const grid::DenseMap map = random_room(60);
    const int reach = *rc::gen::inRange(1, 20);
    for (const Frontier& frontier : find_frontiers(map, 0.0)) {
      std::size_t within = 0;
      for (int y = map.box.min.y - 20; y <= map.box.max.y + 20; ++y) {
        for (int x = map.box.min.x - 20; x <= map.box.max.x + 20; ++x) {
          const bool near = std::ranges::any_of(frontier.cells, [&](std::uint32_t i) {
            const grid::CellIndex c = map.cell(i);
            return (c.x - x) * (c.x - x) + (c.y - y) * (c.y - y) <= reach * reach;
          });
          if (near && map.state({x, y}) == CellState::kUnknown) ++within;
        }
      }
      const SpaceBehind space = space_behind(map, frontier.cells, {}, map.resolution_m * reach);
      RC_ASSERT(space.area_m2 > 0.0);
      RC_ASSERT(space.area_m2 <= static_cast<double>(within) * kCell_m2 + 1e-9);
      RC_ASSERT(space.ahead >= 0.0 && space.ahead <= 1.0);
    }
  }));
}

}  // namespace
}  // namespace topo::goals
