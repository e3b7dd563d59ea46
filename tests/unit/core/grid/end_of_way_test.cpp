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
  const auto end = end_of_way(map, clearance, field, {30, 11}, kRadius_m, within_m);
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
  EXPECT_FALSE(end_of_way(map, clearance, field, {30, 11}, kRadius_m, 1.0));
}

TEST(EndOfWay, IsNowhereFartherThanAskedFor) { EXPECT_FALSE(end_in(two_rooms('?'), 0.4)); }

TEST(EndOfWay, IsNowhereForAGoalThatIsNotFreeOrOutside) {
  const DenseMap map = two_rooms('?');
  TravelField field;
  field.cost_m.assign(map.cells.size(), 0.0F);
  const std::vector<float> room(map.cells.size(), 1.0F);
  EXPECT_FALSE(end_of_way(map, room, field, {0, 0}, kRadius_m, 1.0));
  EXPECT_FALSE(end_of_way(map, room, field, {500, -500}, kRadius_m, 1.0));
}

/// Chains from the goal, in steps, by the definition: free cells with room for the disc, within the box.
std::vector<int> chain_steps(const DenseMap& map, CellIndex goal, double radius_m, int reach) {
  std::vector<int> steps(map.cells.size(), -1);
  const auto is_open = [&](CellIndex c) {
    if (map.state(c) != CellState::kFree) return false;
    if (std::abs(c.x - goal.x) > reach || std::abs(c.y - goal.y) > reach) return false;
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      const CellIndex o = map.cell(i);
      const double away_m = std::hypot(o.x - c.x, o.y - c.y) * map.resolution_m;
      if (map.cells[i] == CellState::kOccupied && away_m < radius_m) return false;
    }
    return true;
  };
  std::vector<CellIndex> queue;
  const auto enter = [&](CellIndex c, int count) {
    if (!is_open(c) || steps[map.index(c)] >= 0) return;
    steps[map.index(c)] = count;
    queue.push_back(c);
  };
  enter(goal, 0);
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const CellIndex c = queue[i];
    for (std::size_t d = 0; d < kNeighbours.size(); d += 2)
      enter({c.x + kNeighbours[d].x, c.y + kNeighbours[d].y}, steps[map.index(c)] + 1);
  }
  return steps;
}

TEST(EndOfWay, IsAtTheEndOfTheShortestChain) {
  EXPECT_TRUE(rc::check([] {
    const DenseMap map = random_map(20);
    const auto clearance = clearance_m(map, Boundary::kOccupiedOrUnknown);
    const auto any_cell = [&] { return map.cell(*rc::gen::inRange<std::size_t>(0, map.cells.size())); };
    const TravelRules rules{.radius_m = 0.11, .preferred_m = 0.2, .crowding = 1.0, .start_m = 0.0};
    const TravelField field = travel_field(map, clearance, any_cell(), rules);
    const CellIndex goal = any_cell();
    const int reach = *rc::gen::inRange(1, 15);
    const auto end = end_of_way(map, clearance, field, goal, 0.11, (reach + 0.5) * map.resolution_m);
    const std::vector<int> steps = chain_steps(map, goal, 0.11, reach);
    int nearest = -1;
    bool some_lack_room = false;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (steps[i] < 0) continue;
      some_lack_room = some_lack_room || clearance[i] < 0.11F;
      if (field.can_stay_at(i) && (nearest < 0 || steps[i] < nearest)) nearest = steps[i];
    }
    if (end) {
      RC_ASSERT(field.can_stay_at(map.index(*end)));
      RC_ASSERT(steps[map.index(*end)] == nearest);
      RC_ASSERT((nearest == 0 || some_lack_room));
    } else {
      RC_ASSERT(nearest != 0);
      // Where the goal itself lacks room, unknown cells are in the way of all chains.
      if (nearest > 0) RC_ASSERT(clearance[map.index(goal)] >= 0.11F);
    }
  }));
}

}  // namespace
}  // namespace topo::grid
