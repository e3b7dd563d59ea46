// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/grid/end_of_way.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/grid/distance.hpp"
#include "tests/unit/core/grid/maps.hpp"

namespace topo::grid {
namespace {

constexpr double kRadius_m = 0.12;  // needs five free cells of 0.05 m

/// Two rooms, and a door of seven cells between them of which one sees four; `jamb`: what the other three
/// are.
DenseMap two_rooms(char jamb) {
  std::vector<std::string> rows(21, std::string(41, '.'));
  for (std::size_t y = 0; y < rows.size(); ++y) rows[y][20] = y < 7 || y > 13 ? '#' : y > 10 ? jamb : '.';
  for (const std::size_t y : {std::size_t{0}, rows.size() - 1}) rows[y].assign(41, '#');
  for (std::string& row : rows) row.front() = row.back() = '#';
  return drawn_map(rows);
}

std::optional<CellIndex> end_in(const DenseMap& map, double within_m) {
  const TravelRules rules{.radius_m = kRadius_m, .preferred_m = 0.2, .crowding = 1.0, .start_m = 0.0};
  const auto clearance = clearance_m(map, Boundary::kOccupiedOrUnknown);
  const TravelField field = travel_field(map, clearance, {8, 10}, rules);
  const auto end = end_of_way(map, clearance, field, {30, 11}, kRadius_m, {within_m});
  EXPECT_TRUE(!end || !std::isinf(field.cost_m[map.index(*end)]));
  return end;
}

TEST(EndOfWay, IsTheGoalWhereTheRobotFitsThroughTheDoor) {
  EXPECT_EQ(end_in(two_rooms('.'), 1.0), (CellIndex{30, 11}));
}

TEST(EndOfWay, IsInFrontOfADoorThatIsKnownInPart) {
  const auto end = end_in(two_rooms('?'), 1.0);
  ASSERT_TRUE(end);
  EXPECT_LE(end->x, 19);
  EXPECT_GE(end->x, 17);
  EXPECT_NEAR(end->y, 11, 3);
}

TEST(EndOfWay, IsNowhereWhereWallsLeaveTooLittleRoom) { EXPECT_FALSE(end_in(two_rooms('#'), 1.0)); }

/// A person in the door: when they are gone there is a way.
TEST(EndOfWay, IsNowhereWhereTheMapHasAWay) {
  const DenseMap map = two_rooms('.');
  const auto clearance = clearance_m(map, Boundary::kOccupiedOrUnknown);
  TravelField field;
  for (std::size_t i = 0; i < map.cells.size(); ++i)
    field.cost_m.push_back(map.cell(i).x < 17 ? 1.0F : std::numeric_limits<float>::infinity());
  EXPECT_FALSE(end_of_way(map, clearance, field, {30, 11}, kRadius_m, {1.0}));
}

TEST(EndOfWay, IsNowhereFartherThanAskedFor) { EXPECT_FALSE(end_in(two_rooms('?'), 0.4)); }

TEST(EndOfWay, IsNowhereForAGoalThatIsNotFreeOrOutside) {
  const DenseMap map = two_rooms('?');
  TravelField field;
  field.cost_m.assign(map.cells.size(), 0.0F);
  const std::vector<float> room(map.cells.size(), 1.0F);
  EXPECT_FALSE(end_of_way(map, room, field, {0, 0}, kRadius_m, {1.0}));
  EXPECT_FALSE(end_of_way(map, room, field, {500, -500}, kRadius_m, {1.0}));
}

/// Shadows of two pillars, each two cells wide, across the whole second room.
TEST(EndOfWay, LiesBeforeTheShadowsThatItMayCross) {
  DenseMap map = two_rooms('.');
  for (const int x : {24, 27})
    for (int y = 1; y < 20; ++y)
      for (const int wide : {0, 1}) map.cells[map.index({x + wide, y})] = CellState::kUnknown;
  const auto clearance = clearance_m(map, Boundary::kOccupiedOrUnknown);
  const TravelRules rules{.radius_m = kRadius_m, .preferred_m = 0.2, .crowding = 1.0, .start_m = 0.0};
  const TravelField field = travel_field(map, clearance, {8, 10}, rules);
  const auto end_past = [&](double unseen_m) {
    return end_of_way(map, clearance, field, {34, 11}, kRadius_m, {HUGE_VAL, unseen_m});
  };
  EXPECT_FALSE(end_past(0.16));
  const auto end = end_past(0.21);
  ASSERT_TRUE(end);
  EXPECT_GE(end->x, 20);
  EXPECT_LT(end->x, 24);
}

/// Chains from the goal by the definition: free or unknown cells with room for the disc, within the box.
/// Unknown cells of the best one to each cell, and its steps; -1: none.
struct Chain {
  int unknown = -1, steps = -1;
  [[nodiscard]] bool is_better_than(const Chain& other) const {
    return other.unknown < 0 || unknown < other.unknown || (unknown == other.unknown && steps < other.steps);
  }
};
std::vector<Chain> chains(const DenseMap& map, CellIndex goal, double radius_m, int reach) {
  std::vector<Chain> best(map.cells.size());
  const auto is_open = [&](CellIndex c) {
    if (!map.contains(c)) return false;
    if (std::abs(c.x - goal.x) > reach || std::abs(c.y - goal.y) > reach) return false;
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      const CellIndex o = map.cell(i);
      const double away_m = std::hypot(o.x - c.x, o.y - c.y) * map.resolution_m;
      if (map.cells[i] == CellState::kOccupied && away_m < radius_m) return false;
    }
    return true;
  };
  if (map.state(goal) != CellState::kFree || !is_open(goal)) return best;
  best[map.index(goal)] = {0, 0};
  for (bool changed = true; changed;) {  // Bellman and Ford
    changed = false;
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      const CellIndex c = map.cell(i);
      if (best[i].unknown < 0) continue;
      for (std::size_t d = 0; d < kNeighbours.size(); d += 2) {
        const CellIndex to{c.x + kNeighbours[d].x, c.y + kNeighbours[d].y};
        if (!is_open(to)) continue;
        const Chain chain{best[i].unknown + (map.state(to) == CellState::kUnknown ? 1 : 0),
                          best[i].steps + 1};
        if (!chain.is_better_than(best[map.index(to)])) continue;
        best[map.index(to)] = chain;
        changed = true;
      }
    }
  }
  return best;
}

TEST(EndOfWay, IsAtTheEndOfTheChainWithTheFewestUnknownCells) {
  EXPECT_TRUE(rc::check([] {
    const DenseMap map = random_map(14);
    const auto clearance = clearance_m(map, Boundary::kOccupiedOrUnknown);
    const auto any_cell = [&] { return map.cell(*rc::gen::inRange<std::size_t>(0, map.cells.size())); };
    const TravelRules rules{.radius_m = 0.11, .preferred_m = 0.2, .crowding = 1.0, .start_m = 0.0};
    const TravelField field = travel_field(map, clearance, any_cell(), rules);
    const CellIndex goal = any_cell();
    const int reach = *rc::gen::inRange(1, 15), unknown_max = *rc::gen::inRange(0, 6);
    const auto end = end_of_way(map, clearance, field, goal, 0.11,
                                {(reach + 0.5) * map.resolution_m, (unknown_max + 0.5) * map.resolution_m});
    const std::vector<Chain> all = chains(map, goal, 0.11, reach);
    Chain nearest;
    bool some_lack_room = false;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].unknown < 0 || all[i].unknown > unknown_max) continue;
      some_lack_room = some_lack_room || clearance[i] < 0.11F;
      if (field.can_stay_at(i) && all[i].is_better_than(nearest)) nearest = all[i];
    }
    if (end) {
      RC_ASSERT(field.can_stay_at(map.index(*end)));
      RC_ASSERT(all[map.index(*end)].unknown == nearest.unknown);
      if (nearest.unknown == 0) RC_ASSERT(all[map.index(*end)].steps == nearest.steps);
      RC_ASSERT((nearest.steps == 0 || some_lack_room));
    } else {
      RC_ASSERT(nearest.steps != 0);
      // Where the goal itself lacks room, unknown cells are in the way of all chains.
      if (nearest.steps > 0) RC_ASSERT(clearance[map.index(goal)] >= 0.11F);
    }
  }));
}

}  // namespace
}  // namespace topo::grid
