// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/travel/route_map.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

#include "core/grid/distance.hpp"
#include "core/travel/path.hpp"
#include "tests/unit/core/travel/hall.hpp"

namespace topo::travel {
namespace {

using grid::CellIndex;
using grid::CellState;
using types::Vector2;

double nearest_m(const std::vector<Vector2>& route, const Vector2& p) {
  double least_m = HUGE_VAL;
  for (const Vector2& q : route) least_m = std::min(least_m, (p - q).norm());
  return least_m;
}

double length_m(const std::vector<Vector2>& route) {
  double sum_m = 0.0;
  for (std::size_t i = 1; i < route.size(); ++i) sum_m += (route[i] - route[i - 1]).norm();
  return sum_m;
}

TEST(RouteMap, TakesEachRevisionOnce) {
  const Hall open, parted(Doors{});
  RouteMap map(open.rules, {});
  map.take(0, open.cells.grid(), {});
  const std::vector<CellState> first = map.map().cells;
  EXPECT_FALSE(first.empty()) << "the first one, whatever its number";
  map.take(0, parted.cells.grid(), {});
  EXPECT_EQ(map.map().cells, first);
  map.take(7, parted.cells.grid(), {});
  EXPECT_NE(map.map().cells, first);
  EXPECT_EQ(map.revision(), 7U);
}

TEST(RouteMap, OtherLimitsAreThoseOfTheSameRevision) {
  const Hall hall;
  RouteMap map(hall.rules, hall.area);
  const auto middle = [&] { return map.map().state(map.map().cell_at({5.5, 1.5})); };
  map.take(1, hall.cells.grid(), hall.ways());
  EXPECT_EQ(middle(), CellState::kFree);
  types::AreaLimits drawn;
  drawn.keep_out = {{{5.0, 1.0}, {6.0, 1.0}, {6.0, 2.0}, {5.0, 2.0}}};
  EXPECT_TRUE(map.limit(drawn));
  EXPECT_FALSE(map.limit(drawn)) << "they are the same";
  map.take(1, hall.cells.grid(), hall.ways());
  EXPECT_NE(middle(), CellState::kFree);
  EXPECT_TRUE(map.limit({}));
  map.take(1, hall.cells.grid(), hall.ways());
  EXPECT_EQ(middle(), CellState::kFree);
  EXPECT_EQ(map.clearance_m(), grid::clearance_m(map.map(), grid::Boundary::kOccupiedOrUnknown));
}

TEST(RouteMap, AWayThatWasDrivenIsShutByAnAreaOverIt) {
  Hall hall(kOneDoor);
  hall.drive_through();
  EXPECT_TRUE(hall.has_way_through());
  hall.area.keep_out = {{{3.5, 1.4}, {4.5, 1.4}, {4.5, 2.7}, {3.5, 2.7}}};
  EXPECT_FALSE(hall.has_way_through());
}

TEST(RouteMap, ClearanceAndAreaAreThoseOfItsMap) {
  const Hall hall(kOneDoor);
  const RoutesIn map(hall, stands_at(1.0, 1.0));
  EXPECT_EQ(map.clearance_m(), grid::clearance_m(map.map(), grid::Boundary::kOccupiedOrUnknown));
  const auto free = std::count(map.map().cells.begin(), map.map().cells.end(), CellState::kFree);
  EXPECT_EQ(free, 158 * 78 - (78 - 21)) << "what the walls leave";
  EXPECT_NEAR(map.known_m2(), static_cast<double>(free) * 0.0025, 1e-9);
}

TEST(RouteMap, AddsTheDiscsOfTheWaysAndTheLimitsToTheMap) {
  Hall hall;
  hall.way = {stands_at(-2.0, 2.0)};
  hall.mates = {{stands_at(10.0, 2.0)}};
  hall.area.keep_out.push_back({{5.0, 1.0}, {6.0, 1.0}, {6.0, 2.0}, {5.0, 2.0}});
  hall.cells.put({-60, 40}, 0, 5);
  hall.cells.put({240, 40}, 0, 5);
  const RoutesIn map(hall, stands_at(1.0, 1.0));
  const auto state = [&](double x, double y) { return map.map().state(map.map().cell_at({x, y})); };
  EXPECT_EQ(state(-2.0, 2.2), CellState::kFree);
  EXPECT_EQ(state(10.0, 2.2), CellState::kFree);
  EXPECT_EQ(state(-2.0, 2.4), CellState::kUnknown) << "beyond the route's radius";
  EXPECT_EQ(state(5.5, 1.5), CellState::kOccupied);
  EXPECT_TRUE(hall.route({1.0, 1.0}, {5.5, 1.5}).empty());
}

TEST(RouteMap, RoutesLeadFromTheRobotToEachCellThatCanBeReached) {
  Hall hall(kOneDoor);
  EXPECT_TRUE(rc::check([&] {
    const auto any_m = [](int high) { return 0.05 * *rc::gen::inRange(8, high - 8) + 0.025; };
    const Vector2 from{any_m(Hall::kWidth), any_m(Hall::kHeight)},
        to{any_m(Hall::kWidth), any_m(Hall::kHeight)};
    RoutesIn map(hall, stands_at(from.x(), from.y()));
    const CellIndex start = map.map().cell_at(from), target = map.map().cell_at(to);
    const auto route = map.route_to(target);
    const auto whole = grid::travel_field(map.map(), map.clearance_m(), start, hall.rules);
    const auto best = grid::route_to(map.map(), whole, target);
    RC_ASSERT(route.empty() == best.empty());
    if (best.empty()) return;
    RC_ASSERT((route.front() - map.map().centre_of(start)).norm() < 1e-9);
    RC_ASSERT((route.back() - map.map().centre_of(target)).norm() < 1e-9);
    const auto shortest = smooth_path(map.map(), map.clearance_m(), best, hall.rules.preferred_m, {});
    RC_ASSERT(length_m(route) <= 1.05 * length_m(shortest) + 0.2);
    if (whole.cost_m[map.map().index(target)] < 6.0F) RC_ASSERT(route == shortest);
  }));
}

TEST(RouteMap, NothingLeadsThroughAWallOrOutOfTheHall) {
  EXPECT_FALSE(Hall(Doors{}).has_way_through());
  EXPECT_TRUE(Hall(kOneDoor).has_way_through());
  EXPECT_FALSE(Hall(Doors{{36, 45}}).has_way_through()) << "0.45 m";
  EXPECT_TRUE(Hall(kOneDoor).route({1.0, 1.0}, {4.025, 0.5}).empty()) << "a cell of the wall";
}

TEST(RouteMap, TheCoarseMapIsThatOfTheMapAndItsField) {
  const Hall hall(kOneDoor);
  RoutesIn map(hall, stands_at(1.0, 1.0));
  const CoarseMap expected = coarser(map.map(), map.clearance_m(), RouteMapParams{}.coarse_doublings);
  EXPECT_EQ(map.coarse().map.cells, expected.map.cells);
  EXPECT_EQ(map.coarse().clearance_m, expected.clearance_m);
  const CellIndex start = expected.map.cell_at({1.0, 1.0});
  const auto field = grid::travel_field(expected.map, expected.clearance_m, start, hall.rules);
  EXPECT_EQ(map.coarse_field().cost_m, field.cost_m);
}

TEST(RouteMap, CostsBelowTheSettledOnesAreFinal) {
  const Hall hall(kOneDoor);
  RoutesIn map(hall, stands_at(1.0, 1.0));
  const auto whole =
      grid::travel_field(map.map(), map.clearance_m(), map.map().cell_at({1.0, 1.0}), hall.rules);
  for (const double bound_m : {0.5, 2.0, 5.0, HUGE_VAL}) {
    map.settle(bound_m);
    EXPECT_GE(map.settled_m(), std::min(bound_m, 1e9));
    for (std::size_t i = 0; i < whole.cost_m.size(); ++i) {
      const bool is_final = static_cast<double>(whole.cost_m[i]) < map.settled_m() - 1e-5;
      ASSERT_TRUE(!is_final || map.field().cost_m[i] == whole.cost_m[i]) << i;
    }
  }
}

TEST(RouteMap, AnEchoShutsADoorThatNobodyDroveThrough) {
  Hall hall(kOneDoor);
  hall.overlays.echoed = {{4.025, Hall::kMiddle_m}};
  EXPECT_FALSE(hall.has_way_through());
  hall.drive_through();
  EXPECT_TRUE(hall.has_way_through()) << "the robot's own way";
  hall.mates = {hall.way};
  hall.way.clear();
  EXPECT_TRUE(hall.has_way_through()) << "a team-mate's";
}

TEST(RouteMap, WhatTheRobotGotStuckOnShutsItsOwnWayToo) {
  Hall hall(kOneDoor);
  hall.drive_through();
  EXPECT_TRUE(hall.has_way_through());
  hall.overlays.stuck_on = {{4.025, Hall::kMiddle_m}};
  EXPECT_FALSE(hall.has_way_through());
}

TEST(RouteMap, OnlyNoiseOfTheNewestScanLeavesTheWayOpen) {
  const auto passes = [](double off_m, bool drove, double from_x_m) {
    Hall hall(kOneDoor);
    if (drove) hall.drive_through();
    for (const double side : {-1.0, 1.0})
      hall.overlays.seen_now.emplace_back(4.025, Hall::kMiddle_m + side * off_m);
    return hall.has_way_through(from_x_m);
  };
  EXPECT_TRUE(passes(0.27, true, 1.5));
  EXPECT_FALSE(passes(0.27, false, 1.5)) << "closer than the route's radius";
  EXPECT_FALSE(passes(0.2, true, 1.5)) << "more than noise";
  EXPECT_FALSE(passes(0.27, true, 0.5)) << "farther than the scan counts";
  EXPECT_TRUE(passes(0.4, false, 1.5));
}

TEST(RouteMap, TheLastBitBeforeAKeyframeIsOpenToo) {
  Hall hall(kOneDoor);
  hall.way = {stands_at(3.8, Hall::kMiddle_m)};
  hall.overlays.echoed = {{4.025, Hall::kMiddle_m}};
  EXPECT_TRUE(!hall.route({4.4, Hall::kMiddle_m}, {1.5, Hall::kMiddle_m}).empty()) << "it came through";
  hall.way = {stands_at(3.2, Hall::kMiddle_m)};
  EXPECT_TRUE(hall.route({4.4, Hall::kMiddle_m}, {1.5, Hall::kMiddle_m}).empty()) << "it was carried";
}

TEST(RouteMap, RoutesLeadRoundATeamMateWhereThereIsRoom) {
  const Vector2 from{1.0, 2.0}, to{7.0, 2.0}, mate{4.025, Hall::kMiddle_m};
  Hall hall;
  EXPECT_LT(nearest_m(hall.route(from, to), mate), 0.1);
  hall.overlays.going_at = {mate};
  EXPECT_GT(nearest_m(hall.route(from, to), mate), 1.0);
  Hall with_door(kOneDoor);
  with_door.overlays.going_at = {mate};
  EXPECT_LT(nearest_m(with_door.route(from, to), mate), 0.2) << "no other way: it will move on";
}

TEST(RouteMap, TheOverlaysOfOnePeriodAreGoneInTheNext) {
  const Hall hall(kOneDoor);
  RoutesIn map(hall, stands_at(1.5, Hall::kMiddle_m));
  const CellIndex target = map.map().cell_at({6.5, Hall::kMiddle_m});
  const auto route = map.route_to(target);
  Overlays overlays;
  overlays.stuck_on = {{4.025, Hall::kMiddle_m}};
  for (int period = 0; period < 2; ++period) {
    map.begin(stands_at(1.5, Hall::kMiddle_m), {}, overlays);
    EXPECT_TRUE(map.route_to(target).empty());
    map.begin(stands_at(1.5, Hall::kMiddle_m), {}, {});
    EXPECT_EQ(map.route_to(target), route);
  }
}

TEST(RouteMap, TheReachableCellIsTheNearestToTurnAt) {
  const Hall hall(kOneDoor);
  RoutesIn map(hall, stands_at(1.0, 1.0));
  const auto whole =
      grid::travel_field(map.map(), map.clearance_m(), map.map().cell_at({1.0, 1.0}), hall.rules);
  EXPECT_TRUE(rc::check([&] {
    const Vector2 p{0.05 * *rc::gen::inRange(-20, 180) + 0.025, 0.05 * *rc::gen::inRange(-20, 100) + 0.025};
    const auto cell = map.reachable_cell(p);
    double least_m = HUGE_VAL;
    for (std::size_t i = 0; i < whole.cost_m.size(); ++i) {
      if (whole.can_stay_at(i))
        least_m = std::min(least_m, (map.map().centre_of(map.map().cell(i)) - p).norm());
    }
    RC_ASSERT(cell.has_value() == (least_m <= 0.5 + 1e-9));
    if (cell) RC_ASSERT(std::abs((map.map().centre_of(*cell) - p).norm() - least_m) < 1e-9);
  }));
}

/// 0.45 m wide, by its cells: a robot gets through and does not turn there.
struct HallWithTightDoor : Hall {
  HallWithTightDoor() : Hall(Doors{{36, 45}}) { rules.tight_m = 0.24; }
};

TEST(RouteMap, InATightDoorTheCellToTurnAtIsBesideIt) {
  const HallWithTightDoor hall;
  RoutesIn map(hall, stands_at(1.0, 1.0));
  const auto cell = map.reachable_cell({4.025, Hall::kMiddle_m});
  ASSERT_TRUE(cell);
  EXPECT_NE(cell->x, Hall::kWallX);
  EXPECT_GE(map.clearance_m()[map.map().index(*cell)], static_cast<float>(hall.rules.radius_m));
  EXPECT_TRUE(hall.has_way_through());
}

TEST(RouteMap, ATightPassageIsFoundOnTheNextStretchAlone) {
  const HallWithTightDoor hall;
  const auto tight_from = [&](double x_m) {
    const Vector2 here{x_m, Hall::kMiddle_m};
    RoutesIn map(hall, stands_at(x_m, Hall::kMiddle_m));
    return map.tight_ahead(map.route_to(map.map().cell_at({6.5, Hall::kMiddle_m})), here);
  };
  for (const double x_m : {3.0, 3.3, 3.6}) {
    const auto tight = tight_from(x_m);
    ASSERT_TRUE(tight) << x_m;
    EXPECT_LT((*tight - Vector2(4.025, Hall::kMiddle_m)).norm(), 0.11) << "where it is narrowest";
  }
  EXPECT_FALSE(tight_from(1.5)) << "too far ahead";
  EXPECT_FALSE(tight_from(4.025)) << "the robot stands in it";
  EXPECT_FALSE(tight_from(5.0)) << "behind it";
  EXPECT_FALSE(RoutesIn(hall, stands_at(3.3, Hall::kMiddle_m)).tight_ahead({}, {3.3, Hall::kMiddle_m}));
}

TEST(RouteMap, EachCallGivesWhatItWouldGiveAlone) {
  const Hall hall(Doors{{10, 31}, {50, 71}});
  EXPECT_TRUE(rc::check([&] {
    const auto any_cell = [] {
      return CellIndex{*rc::gen::inRange(8, Hall::kWidth - 8), *rc::gen::inRange(8, Hall::kHeight - 8)};
    };
    const auto here = stands_at(1.0, 0.05 * *rc::gen::inRange(10, 70));
    RoutesIn alone(hall, here), after_others(hall, here);
    const CellIndex target = any_cell();
    const auto expected = alone.route_to(target);
    for (int calls = *rc::gen::inRange(1, 4); calls > 0; --calls) {
      switch (*rc::gen::inRange(0, 4)) {
        case 0:
          (void)after_others.coarse_field();
          break;
        case 1:
          (void)after_others.route_to(any_cell());
          break;
        case 2:
          (void)after_others.reachable_cell({4.0, 2.0});
          break;
        default:
          after_others.settle(*rc::gen::inRange(1, 20));
          break;
      }
    }
    RC_ASSERT(after_others.route_to(target) == expected);
  }));
}

TEST(NewlyKnown, IsTheAreaKnownNowWithinTheSquare) {
  EXPECT_TRUE(rc::check([] {
    CountedCells before, now;
    grid::DenseMap then;
    then.box = {{-20, -20}, {19, 19}};
    then.cells.assign(1600, CellState::kUnknown);
    for (int changes = *rc::gen::inRange(0, 200); changes > 0; --changes) {
      const CellIndex c{*rc::gen::inRange(-30, 30), *rc::gen::inRange(-30, 30)};
      if (then.contains(c) && *rc::gen::arbitrary<bool>())
        then.cells[then.index(c)] = *rc::gen::element(CellState::kFree, CellState::kOccupied);
      now.put(c, *rc::gen::element<std::uint16_t>(0, 3), 1);
    }
    const Vector2 centre{0.05 * *rc::gen::inRange(-25, 25) + 0.01, 0.05 * *rc::gen::inRange(-25, 25) + 0.02};
    const double reach_m = 0.05 * *rc::gen::inRange(0, 20);
    int cells = 0;
    for (int y = -60; y < 60; ++y) {
      for (int x = -60; x < 60; ++x) {
        const bool within = (x + 1) * 0.05 > centre.x() - reach_m && x * 0.05 <= centre.x() + reach_m &&
                            (y + 1) * 0.05 > centre.y() - reach_m && y * 0.05 <= centre.y() + reach_m;
        const bool is_new =
            then.state({x, y}) == CellState::kUnknown && now.grid().state({x, y}) != CellState::kUnknown;
        cells += within && is_new ? 1 : 0;
      }
    }
    RC_ASSERT(std::abs(newly_known_m2(then, now.grid(), centre, reach_m) - cells * 0.0025) < 1e-9);
  }));
}

}  // namespace
}  // namespace topo::travel
