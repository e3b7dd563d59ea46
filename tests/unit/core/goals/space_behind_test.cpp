// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/space_behind.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

#include "core/goals/continued_walls.hpp"
#include "core/goals/frontiers.hpp"
#include "tests/unit/core/goals/scene.hpp"

namespace topo::goals {
namespace {

using grid::CellState;
using places::DrawnMap;

constexpr double kCell_m = 0.05, kCell_m2 = kCell_m * kCell_m;

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
    // The cells of the pocket before the wall: in a column those below the lowest cell that the wall passes
    // in it, which is at one of the column's sides.
    const double slope = (to_y - from_y) / (width + 1.0);
    int before = 0;
    for (int x = 7; x < width + 7; ++x)
      before += static_cast<int>(std::lround(from_y + slope * (x - 6.0) - std::abs(slope) / 2.0)) - 27;
    RC_ASSERT(space.ahead == 0.0);
    // The wall's cells are taken at steps of a cell: by one in a column they may differ.
    RC_ASSERT(space.area_m2 <= (before + width) * kCell_m2 + 1e-9);
    RC_ASSERT(space.area_m2 >= (before - width) * kCell_m2 - 1e-9);
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

/// A pocket round a corner: the frontier bends, and what is out of reach of one of its cells is near another.
TEST(SpaceBehind, OfABentPocketIsNothingAhead) {
  EXPECT_TRUE(rc::check([] {
    const int depth = *rc::gen::inRange(1, 20);
    const DrawnMap drawn = DrawnMap(120, 120)
                               .occupied(5, 5, 72 + depth, 72 + depth)
                               .fill(7, 7, 70 + depth, 70 + depth, CellState::kUnknown)
                               .free(7, 7, 70, 70);
    const SpaceBehind space = behind_only_frontier(drawn.map(), {}, kCell_m * (1.5 * depth + 2));
    RC_ASSERT(space.ahead == 0.0);
    RC_ASSERT(std::abs(space.area_m2 - (2 * 63 + depth) * depth * kCell_m2) < 1e-9);
  }));
}

/// The same opening askew: what is behind it is as deep.
TEST(SpaceBehind, IsAsDeepBehindAFrontierAskew) {
  DrawnMap drawn(300, 300);
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < 300; ++x)
      if (x + y < 200) drawn.free(x, y, x + 1, y + 1);
  const grid::DenseMap& map = drawn.map();
  std::vector<std::uint32_t> diagonal;
  for (int x = 61; x < 140; ++x) diagonal.push_back(static_cast<std::uint32_t>(map.index({x, 199 - x})));
  const double length_m = std::sqrt(2.0) * static_cast<double>(diagonal.size()) * kCell_m;
  EXPECT_NEAR(space_behind(map, diagonal, {}, 1.0).area_m2, length_m * 1.0 + 0.5 * 3.14, 0.25);
}

/// Unknown cells round a map are no knowledge.
TEST(SpaceBehind, IsTheSameHoweverLargeTheMapIs) {
  EXPECT_TRUE(rc::check([] {
    const grid::DenseMap map = random_room(50);
    grid::DenseMap padded = map;
    const int more = *rc::gen::inRange(1, 40);
    padded.box = {{map.box.min.x - more, map.box.min.y - more}, {map.box.max.x + more, map.box.max.y + more}};
    padded.cells.assign(static_cast<std::size_t>(padded.box.width() * padded.box.height()),
                        CellState::kUnknown);
    for (std::size_t i = 0; i < map.cells.size(); ++i) padded.cells[padded.index(map.cell(i))] = map.cells[i];
    const std::vector<types::Segment> walls{{random_point(2.5), random_point(2.5)}};
    for (const Frontier& frontier : find_frontiers(map, 0.3)) {
      std::vector<std::uint32_t> same;
      for (const std::uint32_t i : frontier.cells)
        same.push_back(static_cast<std::uint32_t>(padded.index(map.cell(i))));
      const SpaceBehind one = space_behind(map, frontier.cells, continued_walls(map, walls), 1.0);
      const SpaceBehind other = space_behind(padded, same, continued_walls(padded, walls), 1.0);
      RC_ASSERT(one.area_m2 == other.area_m2);
      RC_ASSERT(one.ahead == other.ahead);
    }
  }));
}

TEST(SpaceBehind, OfNoOpeningIsNone) {
  const SpaceBehind space = space_behind(DrawnMap(30, 30).free(5, 5, 25, 25).map(), {}, {}, 2.4);
  EXPECT_EQ(space.area_m2, 0.0);
  EXPECT_EQ(space.ahead, 0.0);
  const std::vector<std::uint32_t> cell{500};
  EXPECT_EQ(space_behind(DrawnMap(30, 30).free(5, 5, 25, 25).map(), cell, {}, 0.01).area_m2, 0.0)
      << "no reach";
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
