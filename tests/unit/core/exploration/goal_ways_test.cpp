// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/goal_ways.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "core/grid/distance.hpp"

namespace topo::exploration {
namespace {

using grid::CellIndex;
using grid::CellState;

/// Two rooms of 4 by 4 m with a door of 1 m between them, in cells of 0.2 m.
struct Rooms {
  grid::DenseMap map;
  std::vector<float> clearance_m;

  explicit Rooms(bool door = true) {
    map.resolution_m = 0.2;
    map.box = {{0, 0}, {42, 21}};
    map.cells.assign(43U * 22U, CellState::kOccupied);
    for (int y = 1; y < 21; ++y) {
      for (int x = 1; x < 42; ++x) {
        const bool wall = x == 21 && !(door && y >= 9 && y <= 13);
        if (!wall) map.cells[map.index({x, y})] = CellState::kFree;
      }
    }
    clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
  }
};

std::vector<CellIndex> arbitrary_cells() {
  std::vector<CellIndex> cells(*rc::gen::inRange<std::size_t>(0, 6));
  for (CellIndex& cell : cells) {
    cell = {*rc::gen::inRange(3, 8), *rc::gen::inRange(4, 18)};
    if (*rc::gen::arbitrary<bool>()) cell.x += 30;
  }
  return cells;
}

void search_for_all(const Rooms& rooms, const std::vector<CellIndex>& cells, GoalWays& ways) {
  for (std::size_t turn = 0; turn < cells.size(); ++turn)
    ways.update(rooms.map, rooms.clearance_m, {}, cells);
}

TEST(GoalWays, areThoseOfAFreshSearchWhateverGoalsThereWereBefore) {
  const Rooms rooms;
  EXPECT_TRUE(rc::check([&] {
    GoalWays ways;
    std::vector<CellIndex> cells;
    for (int i = *rc::gen::inRange(1, 4); i > 0; --i) {
      std::vector<CellIndex> next = arbitrary_cells();
      if (!cells.empty() && *rc::gen::arbitrary<bool>()) next.push_back(cells.front());
      cells = next;
      ways.update(rooms.map, rooms.clearance_m, {}, cells);
    }
    GoalWays fresh;
    search_for_all(rooms, cells, ways);
    search_for_all(rooms, cells, fresh);
    for (std::size_t a = 0; a < cells.size(); ++a) {
      for (std::size_t b = 0; b < cells.size(); ++b) {
        RC_ASSERT(std::abs(ways.between_m(a, b) - fresh.between_m(a, b)) < 1e-3);
        RC_ASSERT(ways.between_m(a, b) == ways.between_m(b, a));
      }
    }
  }));
}

TEST(GoalWays, leadThroughTheDoorUntilItIsKnownAsClosed) {
  const Rooms open, closed(false);
  const std::vector<CellIndex> cells{{5, 3}, {37, 3}, {37, 18}};
  GoalWays ways;
  ways.update(open.map, open.clearance_m, {}, cells);
  EXPECT_GT(ways.between_m(0, 1), 32 * 0.2) << "not through the wall";
  EXPECT_LT(ways.between_m(0, 1), 14.0);
  EXPECT_EQ(ways.between_m(2, 2), 0.0);
  for (std::size_t i = 0; i < cells.size(); ++i) ways.update(closed.map, closed.clearance_m, {}, cells);
  EXPECT_TRUE(std::isinf(ways.between_m(0, 1)));
  EXPECT_LT(ways.between_m(1, 2), 6.0);
}

TEST(GoalWays, ofManyNewGoalsAreEstimatedByWaysThatThereAre) {
  const Rooms rooms;
  EXPECT_TRUE(rc::check([&] {
    std::vector<CellIndex> cells = arbitrary_cells();
    for (const CellIndex& more : arbitrary_cells()) cells.push_back(more);
    GoalWays ways;
    ways.update(rooms.map, rooms.clearance_m, {}, cells);
    GoalWays all;
    search_for_all(rooms, cells, all);
    for (std::size_t a = 0; a < cells.size(); ++a) {
      for (std::size_t b = 0; b < cells.size(); ++b) {
        RC_ASSERT(std::isfinite(ways.between_m(a, b)));
        RC_ASSERT(ways.between_m(a, b) > all.between_m(a, b) - 1e-3);
        RC_ASSERT(ways.between_m(a, b) == ways.between_m(b, a));
      }
    }
  }));
}

TEST(GoalWays, ofGoalsThatAllMoveAreAboutWhatTheyWere) {
  const Rooms rooms;
  std::vector<CellIndex> cells{{4, 4}, {4, 17}, {10, 10}, {33, 4}, {33, 17}, {37, 10}};
  GoalWays ways, all;
  search_for_all(rooms, cells, ways);
  for (CellIndex& cell : cells) cell.x += 2;
  ways.update(rooms.map, rooms.clearance_m, {}, cells);
  search_for_all(rooms, cells, all);
  for (std::size_t a = 0; a < cells.size(); ++a)
    for (std::size_t b = 0; b < cells.size(); ++b)
      EXPECT_NEAR(ways.between_m(a, b), all.between_m(a, b), 1.5) << a << " to " << b;
}

}  // namespace
}  // namespace topo::exploration
