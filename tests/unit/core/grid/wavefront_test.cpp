// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/grid/wavefront.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <queue>

#include "core/grid/distance.hpp"
#include "tests/unit/core/grid/maps.hpp"

namespace topo::grid {
namespace {

constexpr TravelRules kSmallRobot{.radius_m = 0.10, .preferred_m = 0.25, .crowding = 2.0, .start_m = 0.0};

CellIndex moved(CellIndex cell, CellIndex by) { return {cell.x + by.x, cell.y + by.y}; }

bool open(const DenseMap& map, const std::vector<float>& clearance, CellIndex cell,
          const TravelRules& rules) {
  return map.state(cell) == CellState::kFree &&
         clearance[map.index(cell)] >= static_cast<float>(rules.radius_m);
}

double per_metre(double clearance, const TravelRules& rules) {
  const double lacking = std::max(0.0, rules.preferred_m - clearance);
  return 1.0 + rules.crowding * lacking / (rules.preferred_m - rules.radius_m);
}

/// The same by the textbook, with a heap and doubles; the start must be open.
std::vector<double> plain_dijkstra(const DenseMap& map, const std::vector<float>& clearance, CellIndex start,
                                   const TravelRules& rules) {
  std::vector<double> cost(map.cells.size(), HUGE_VAL);
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  queue.push({cost[map.index(start)] = 0.0, map.index(start)});
  while (!queue.empty()) {
    const auto [so_far, i] = queue.top();
    queue.pop();
    if (so_far > cost[i]) continue;
    for (const CellIndex by : kNeighbours) {
      const CellIndex next = moved(map.cell(i), by);
      if (!map.contains(next) || !open(map, clearance, next, rules)) continue;
      const std::size_t n = map.index(next);
      const double length = std::hypot(by.x, by.y) * map.resolution_m;
      const double c =
          so_far + length * (per_metre(clearance[i], rules) + per_metre(clearance[n], rules)) / 2.0;
      if (c < cost[n]) queue.push({cost[n] = c, n});
    }
  }
  return cost;
}

std::vector<CellIndex> open_cells(const DenseMap& map, const std::vector<float>& clearance,
                                  const TravelRules& rules) {
  std::vector<CellIndex> cells;
  for (std::size_t i = 0; i < map.cells.size(); ++i)
    if (open(map, clearance, map.cell(i), rules)) cells.push_back(map.cell(i));
  return cells;
}

struct Place {
  DenseMap map;
  std::vector<float> clearance;
  std::vector<CellIndex> open;  ///< to the small robot; some are
};
Place random_place(int most_cells) {
  Place place{random_map(most_cells), {}, {}};
  place.clearance = clearance_m(place.map, Boundary::kOccupiedOrUnknown);
  place.open = open_cells(place.map, place.clearance, kSmallRobot);
  RC_PRE(!place.open.empty());
  return place;
}

TEST(Wavefront, CostsWhatPlainDijkstraFinds) {
  EXPECT_TRUE(rc::check("optimal", [] {
    const auto [map, clearance, starts] = random_place(40);
    const CellIndex start = *rc::gen::elementOf(starts);
    const TravelField field = travel_field(map, clearance, start, kSmallRobot);
    const auto expected = plain_dijkstra(map, clearance, start, kSmallRobot);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      if (std::isinf(expected[i])) {
        RC_ASSERT(std::isinf(field.cost_m[i]));
      } else {
        RC_ASSERT(std::abs(static_cast<double>(field.cost_m[i]) - expected[i]) <= 1e-4 * (1.0 + expected[i]));
      }
    }
  }));
}

TEST(Wavefront, CostsAreSymmetricAndKeepTheTriangleInequality) {
  EXPECT_TRUE(rc::check("a metric", [] {
    const auto [map, clearance, cells] = random_place(30);
    const CellIndex a = *rc::gen::elementOf(cells), b = *rc::gen::elementOf(cells);
    const auto from_a = travel_field(map, clearance, a, kSmallRobot);
    const auto from_b = travel_field(map, clearance, b, kSmallRobot);
    const float ab = from_a.cost_m[map.index(b)], ba = from_b.cost_m[map.index(a)];
    RC_ASSERT(std::isinf(ab) == std::isinf(ba));
    if (std::isinf(ab)) return;
    RC_ASSERT(std::abs(ab - ba) <= 1e-3F);
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      if (std::isinf(from_b.cost_m[i])) continue;
      RC_ASSERT(from_a.cost_m[i] <= ab + from_b.cost_m[i] + 1e-3F);
    }
  }));
}

TEST(Wavefront, RoutesKeepTheClearanceAndAddUpToTheCost) {
  EXPECT_TRUE(rc::check("routes", [] {
    const auto [map, clearance, cells] = random_place(40);
    const CellIndex start = *rc::gen::elementOf(cells), goal = *rc::gen::elementOf(cells);
    const TravelField field = travel_field(map, clearance, start, kSmallRobot);
    const auto route = route_to(map, field, goal);
    RC_ASSERT(route.empty() == std::isinf(field.cost_m[map.index(goal)]));
    if (route.empty()) return;
    RC_ASSERT(route.front() == start);
    RC_ASSERT(route.back() == goal);
    double cost = 0.0;
    for (std::size_t i = 1; i < route.size(); ++i) {
      RC_ASSERT(open(map, clearance, route[i], kSmallRobot));
      const int dx = route[i].x - route[i - 1].x, dy = route[i].y - route[i - 1].y;
      RC_ASSERT(std::max(std::abs(dx), std::abs(dy)) == 1);
      cost += std::hypot(dx, dy) * map.resolution_m / 2.0 *
              (per_metre(clearance[map.index(route[i - 1])], kSmallRobot) +
               per_metre(clearance[map.index(route[i])], kSmallRobot));
    }
    RC_ASSERT(std::abs(cost - static_cast<double>(field.cost_m[map.index(goal)])) <= 1e-4 * (1.0 + cost));
  }));
}

TEST(Wavefront, GoesRoundWhatIsNear) {
  // A corridor of 2 m: the way along it keeps to the middle, though a wall is no farther.
  const DenseMap map = filled_map(120, 40, CellState::kFree);
  const auto clearance = clearance_m(map, Boundary::kOccupiedOrUnknown);
  const TravelRules rules;
  const TravelField field = travel_field(map, clearance, {10, 7}, rules);
  const auto route = route_to(map, field, {110, 7});
  ASSERT_FALSE(route.empty());
  EXPECT_GE(clearance[map.index(route[route.size() / 2])], static_cast<float>(rules.preferred_m) - 0.05F);
}

TEST(Wavefront, ReachesNothingFromOutsideTheMapOrInEmptyOnes) {
  const DenseMap map = filled_map(20, 20, CellState::kFree);
  const auto clearance = clearance_m(map, Boundary::kOccupiedOrUnknown);
  const TravelField field = travel_field(map, clearance, {100, 100}, {});
  EXPECT_THAT(field.cost_m, testing::Each(testing::Gt(1e9F)));
  EXPECT_TRUE(route_to(map, field, {10, 10}).empty());
  EXPECT_TRUE(travel_field(DenseMap{}, {}, {0, 0}, {}).cost_m.empty());
}

TEST(Wavefront, FromTheBorderReachesTheStartOnly) {
  const DenseMap map = filled_map(20, 20, CellState::kFree);
  const auto clearance = clearance_m(map, Boundary::kOccupiedOrUnknown);
  for (const CellIndex start : {CellIndex{-1, -1}, CellIndex{20, 20}, CellIndex{-1, 5}}) {
    const TravelField field = travel_field(map, clearance, start, {});
    EXPECT_EQ(field.cost_m[map.index(start)], 0.0F);
    EXPECT_THAT(route_to(map, field, start), testing::ElementsAre(start));
    EXPECT_TRUE(route_to(map, field, {10, 10}).empty());
  }
}

TEST(Wavefront, KnowsNoWayThroughOccupiedOrUnknownCells) {
  for (const auto state : {CellState::kOccupied, CellState::kUnknown}) {
    DenseMap map = filled_map(80, 40, CellState::kFree);
    for (int y = 0; y < 40; ++y) map.cells[map.index({40, y})] = state;
    // With unknown space open in the clearance, it is still closed to the route.
    const auto clearance = clearance_m(map, Boundary::kOccupied);
    const TravelField field = travel_field(map, clearance, {20, 20}, {});
    EXPECT_TRUE(std::isinf(field.cost_m[map.index({60, 20})]));
    EXPECT_FALSE(std::isinf(field.cost_m[map.index({30, 20})]));
  }
}

TEST(Wavefront, ARobotTooNearToAWallMayLeaveAndRunsAwayFromIt) {
  const DenseMap map = filled_map(60, 60, CellState::kFree);
  const auto clearance = clearance_m(map, Boundary::kOccupiedOrUnknown);
  const CellIndex start{30, 2};  // 0.15 m from the unknown
  const TravelField field = travel_field(map, clearance, start, {});
  const auto route = route_to(map, field, {30, 30});
  ASSERT_FALSE(route.empty());
  for (std::size_t i = 1; i < route.size(); ++i) {
    EXPECT_GE(clearance[map.index(route[i])], clearance[map.index(route[i - 1])]) << i;
  }
  // Only near the start: along the wall there is no way.
  EXPECT_TRUE(std::isinf(field.cost_m[map.index({50, 2})]));
}

TEST(Wavefront, LeavingFromBesideAWallIsNoTightPassage) {
  const DenseMap map = filled_map(60, 60, CellState::kFree);
  const auto clearance = clearance_m(map, Boundary::kOccupiedOrUnknown);
  const CellIndex start{3, 30}, away{30, 30};
  ASSERT_LT(clearance[map.index(start)], 0.25F);
  const TravelRules dear{.tight_m = 0.25}, free_of_charge{.tight_m = 0.25, .tightness = 0.0};
  const auto cost_m = [&](const TravelRules& rules) {
    return travel_field(map, clearance, start, rules).cost_m[map.index(away)];
  };
  EXPECT_EQ(cost_m(dear), cost_m(free_of_charge));
}

TEST(Wavefront, LeavesUnknownCellsUnderItsFootprintButNoOthers) {
  DenseMap map = filled_map(60, 60, CellState::kFree);
  for (int y = 27; y <= 33; ++y)
    for (int x = 27; x <= 33; ++x) map.cells[map.index({x, y})] = CellState::kUnknown;
  const auto clearance = clearance_m(map, Boundary::kOccupiedOrUnknown);
  const TravelField inside = travel_field(map, clearance, {30, 30}, {});
  EXPECT_FALSE(std::isinf(inside.cost_m[map.index({50, 30})]));
  const TravelField outside = travel_field(map, clearance, {50, 30}, {});
  EXPECT_TRUE(std::isinf(outside.cost_m[map.index({30, 30})]));
}

TEST(Wavefront, DoesNotSlipBetweenOccupiedCellsThatMeetAtACorner) {
  const DenseMap map = drawn_map({"########", "#...#..#", "#..#...#", "#.#....#", "##.....#", "########"});
  const auto clearance = clearance_m(map, Boundary::kOccupiedOrUnknown);
  const TravelRules rules{.radius_m = 0.05, .preferred_m = 0.1, .crowding = 1.0, .start_m = 0.6};
  const TravelField field = travel_field(map, clearance, {1, 3}, rules);
  EXPECT_TRUE(std::isinf(field.cost_m[map.index({5, 3})]));
  EXPECT_FALSE(std::isinf(field.cost_m[map.index({3, 4})]));
}

TEST(TravelSearch, PausedAndResumedIsTheWholeField) {
  EXPECT_TRUE(rc::check("stages", [] {
    const DenseMap map = random_map(40);
    const auto clearance = clearance_m(map, Boundary::kOccupiedOrUnknown);
    const auto i = *rc::gen::inRange<std::size_t>(0, map.cells.size());
    TravelRules rules = kSmallRobot;
    rules.start_m = *rc::gen::element(0.0, 0.3);
    const TravelField whole = travel_field(map, clearance, map.cell(i), rules);
    TravelSearch search;
    TravelField field;
    for (int again = 0; again < 2; ++again) {
      search.begin(map, clearance, map.cell(i), rules, field);
      for (double bound_m = 0.1; !std::isinf(search.settled_m()); bound_m += 0.4) {
        search.settle(bound_m);
        for (std::size_t k = 0; k < map.cells.size(); ++k) {
          ASSERT_EQ(std::isinf(field.cost_m[k]), std::isinf(whole.cost_m[k])) << "cell " << k;
          ASSERT_GE(field.cost_m[k], whole.cost_m[k]) << "cell " << k;
          if (static_cast<double>(whole.cost_m[k]) >= search.settled_m() - 1e-5) continue;
          ASSERT_EQ(field.cost_m[k], whole.cost_m[k]) << "cell " << k;
          ASSERT_EQ(field.step[k], whole.step[k]) << "cell " << k;
        }
      }
      ASSERT_EQ(field.cost_m, whole.cost_m);
      ASSERT_EQ(field.step, whole.step);
    }
  }));
}

TEST(TravelSearch, AdvancedHasTheCostsThatItSaysAreFinal) {
  EXPECT_TRUE(rc::check("advanced", [] {
    const auto [map, clearance, starts] = random_place(40);
    const CellIndex start = *rc::gen::elementOf(starts);
    const TravelField whole = travel_field(map, clearance, start, kSmallRobot);
    TravelSearch search;
    TravelField field;
    search.begin(map, clearance, start, kSmallRobot, field);
    search.advance(*rc::gen::element(0.2, 0.7, 1.5));
    for (std::size_t k = 0; k < map.cells.size(); ++k) {
      if (static_cast<double>(field.cost_m[k]) < search.settled_m() - 1e-5)
        RC_ASSERT(field.cost_m[k] == whole.cost_m[k]);
    }
    search.settle(HUGE_VAL);
    RC_ASSERT(field.cost_m == whole.cost_m);
  }));
}

TEST(TravelSearch, OfOneMapLeavesNothingToThatOfTheNext) {
  EXPECT_TRUE(rc::check("one after the other", [] {
    TravelSearch search;
    TravelField field;
    for (int maps = 3; maps > 0; --maps) {
      const DenseMap map = random_map(*rc::gen::inRange(8, 40));
      const auto clearance = clearance_m(map, Boundary::kOccupiedOrUnknown);
      const auto i = *rc::gen::inRange<std::size_t>(0, map.cells.size());
      const CellIndex start =
          *rc::gen::element(map.cell(i), map.cell(map.cells.size() / 2), CellIndex{500, 500});
      search.begin(map, clearance, start, kSmallRobot, field);
      if (*rc::gen::arbitrary<bool>()) continue;
      search.settle(HUGE_VAL);
      const TravelField fresh = travel_field(map, clearance, start, kSmallRobot);
      RC_ASSERT(field.cost_m == fresh.cost_m);
      RC_ASSERT(field.step == fresh.step);
    }
  }));
}

/// A door of 0.5 m, in which a P3-DX cannot turn, to a room that has another of 0.9 m far off.
TEST(Wavefront, ATightPassageIsUsedWhenThereIsNoOtherWay) {
  const auto rooms = [](bool with_wide_door) {
    DenseMap map = filled_map(200, 80, CellState::kFree);
    for (int x = 0; x < 200; ++x) {
      const bool is_door = (x >= 41 && x < 51) || (with_wide_door && x >= 150 && x < 168);
      if (!is_door) map.cells[map.index({x, 40})] = CellState::kOccupied;
    }
    return map;
  };
  const TravelRules straight_on{.tight_m = 0.25};
  const CellIndex start{45, 20}, beyond{45, 60}, in_door{45, 40};
  for (const bool with_wide_door : {false, true}) {
    const DenseMap map = rooms(with_wide_door);
    const auto clearance = clearance_m(map, Boundary::kOccupiedOrUnknown);
    const TravelField field = travel_field(map, clearance, start, straight_on);
    const auto route = route_to(map, field, beyond);
    ASSERT_FALSE(route.empty());
    const bool through = std::any_of(route.begin(), route.end(), [&](CellIndex c) { return c == in_door; });
    EXPECT_EQ(through, !with_wide_door);
    EXPECT_FALSE(std::isinf(field.cost_m[map.index(in_door)]));
    EXPECT_FALSE(field.can_stay_at(map.index(in_door)));
  }
  const DenseMap map = rooms(false);
  const auto clearance = clearance_m(map, Boundary::kOccupiedOrUnknown);
  const TravelField field = travel_field(map, clearance, start, {});
  EXPECT_TRUE(std::isinf(field.cost_m[map.index(beyond)])) << "without tight passages";
}

DenseMap mirrored(const DenseMap& map) {
  DenseMap out = map;
  const auto width = static_cast<std::ptrdiff_t>(map.width());
  for (auto row = out.cells.begin(); row != out.cells.end(); row += width) std::reverse(row, row + width);
  return out;
}

TEST(Wavefront, AMirroredMapHasTheMirroredCosts) {
  EXPECT_TRUE(rc::check("mirror", [] {
    const auto [map, clearance, starts] = random_place(36);
    const CellIndex start = *rc::gen::elementOf(starts);
    const auto opposite = [&map](CellIndex c) { return CellIndex{map.box.min.x + map.box.max.x - c.x, c.y}; };
    const DenseMap other = mirrored(map);
    const auto there =
        travel_field(other, clearance_m(other, Boundary::kOccupiedOrUnknown), opposite(start), kSmallRobot);
    const auto here = travel_field(map, clearance, start, kSmallRobot);
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      const float cost_m = here.cost_m[i], other_m = there.cost_m[map.index(opposite(map.cell(i)))];
      RC_ASSERT(std::isinf(cost_m) == std::isinf(other_m));
      if (!std::isinf(cost_m)) RC_ASSERT(std::abs(cost_m - other_m) <= 1e-4F * (1.0F + cost_m));
    }
  }));
}

/// A power of two changes no digit of a number.
TEST(Wavefront, InCellsTwiceAsWideACostIsTwiceAsMuch) {
  EXPECT_TRUE(rc::check("scale", [] {
    DenseMap map = random_map(36);
    TravelRules rules = kSmallRobot;
    rules.start_m = *rc::gen::element(0.0, 0.3);
    const CellIndex start = map.cell(*rc::gen::inRange<std::size_t>(0, map.cells.size()));
    const auto small = travel_field(map, clearance_m(map, Boundary::kOccupiedOrUnknown), start, rules);
    map.resolution_m *= 2.0;
    for (double* value : {&rules.radius_m, &rules.tight_m, &rules.preferred_m, &rules.start_m}) *value *= 2.0;
    const auto large = travel_field(map, clearance_m(map, Boundary::kOccupiedOrUnknown), start, rules);
    for (std::size_t i = 0; i < map.cells.size(); ++i) RC_ASSERT(large.cost_m[i] == 2.0F * small.cost_m[i]);
    RC_ASSERT(large.step == small.step);
  }));
}

TEST(Wavefront, MoreObstaclesOrAWiderRobotCostNoLess) {
  EXPECT_TRUE(rc::check("monotonous", [] {
    DenseMap map = random_map(36);
    const auto clearance = clearance_m(map, Boundary::kOccupiedOrUnknown);
    TravelRules wide = kSmallRobot;
    wide.radius_m += *rc::gen::inRange(0, 3) * 0.04;
    const auto starts = open_cells(map, clearance, wide);
    RC_PRE(!starts.empty());
    const CellIndex start = *rc::gen::elementOf(starts);
    const auto before = travel_field(map, clearance, start, kSmallRobot);
    for (int more = *rc::gen::inRange(0, 6); more > 0; --more)
      map.cells[*rc::gen::inRange<std::size_t>(0, map.cells.size())] = CellState::kOccupied;
    const auto less = clearance_m(map, Boundary::kOccupiedOrUnknown);
    RC_PRE(open(map, less, start, wide));
    const auto after = travel_field(map, less, start, wide);
    for (std::size_t i = 0; i < map.cells.size(); ++i)
      RC_ASSERT(after.cost_m[i] >= before.cost_m[i] - 1e-4F * (1.0F + before.cost_m[i]) ||
                std::isinf(after.cost_m[i]));
  }));
}

TEST(Wavefront, ACellCanBeStayedAtWhereTheRobotCanTurn) {
  EXPECT_TRUE(rc::check("stay", [] {
    const DenseMap map = random_map(30);
    const auto clearance = clearance_m(map, Boundary::kOccupiedOrUnknown);
    TravelRules rules{.radius_m = 0.14, .tight_m = 0.06, .preferred_m = 0.2, .start_m = 0.1};
    const CellIndex start = map.cell(*rc::gen::inRange<std::size_t>(0, map.cells.size()));
    const TravelField tight = travel_field(map, clearance, start, rules);
    for (std::size_t i = 0; i < map.cells.size(); ++i)
      RC_ASSERT(tight.can_stay_at(i) == (!std::isinf(tight.cost_m[i]) && clearance[i] >= 0.14F));
    rules.tight_m = rules.radius_m;
    const TravelField none = travel_field(map, clearance, start, rules);
    for (std::size_t i = 0; i < map.cells.size(); ++i)
      RC_ASSERT(none.can_stay_at(i) == !std::isinf(none.cost_m[i]));
  }));
}

}  // namespace
}  // namespace topo::grid
