// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/travel/route_map.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

#include "core/grid/distance.hpp"
#include "core/travel/path.hpp"
#include "tests/unit/core/travel/counted_cells.hpp"

namespace topo::travel {
namespace {

using grid::CellIndex;
using grid::CellState;
using types::Vector2;

using Doors = std::vector<std::pair<int, int>>;
using Way = std::vector<types::KeyframePose>;

types::KeyframePose stands_at(double x_m, double y_m) {
  return {types::Stamp{}, types::Transform2<types::Map, types::Base>(x_m, y_m, 0.0)};
}

/// A hall of 8 by 4 m within walls, and a wall across at x = 4 m with doors, from y to y in cells.
struct Hall {
  static constexpr int kWidth = 160, kHeight = 80, kWallX = 80;
  static constexpr double kMiddle_m = 2.025;
  CountedCells cells;
  Way way;
  std::vector<Way> mates;
  grid::TravelRules rules;
  types::AreaLimits area;
  Overlays overlays;

  explicit Hall(const Doors& doors = {{0, kHeight}}) {
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const bool outer = x == 0 || y == 0 || x == kWidth - 1 || y == kHeight - 1;
        const bool in_door = std::any_of(
            doors.begin(), doors.end(), [&](const auto& door) { return y >= door.first && y < door.second; });
        const bool is_wall = outer || (x == kWallX && !in_door);
        cells.put({x, y}, is_wall ? 5 : 0, is_wall ? 0 : 5);
      }
    }
  }
  [[nodiscard]] DrivenWays ways() const { return {way, mates}; }
  [[nodiscard]] std::vector<Vector2> route(const Vector2& from, const Vector2& to) const;
  [[nodiscard]] bool has_way_through(double from_x_m = 1.5) const {
    return !route({from_x_m, kMiddle_m}, {6.5, kMiddle_m}).empty();
  }
  void drive_through() {
    for (double x = 0.5; x < 7.0; x += 0.5) way.push_back(stands_at(x, kMiddle_m));
  }
};

/// The map of a hall, with the searches of a period begun.
struct RoutesIn : RouteMap {
  RoutesIn(const Hall& hall, const types::KeyframePose& here) : RouteMap(hall.rules, hall.area) {
    take(1, hall.cells.grid(), hall.ways());
    begin(here, hall.ways(), hall.overlays);
  }
};

std::vector<Vector2> Hall::route(const Vector2& from, const Vector2& to) const {
  RoutesIn map(*this, stands_at(from.x(), from.y()));
  return map.route_to(map.map().cell_at(to));
}

const Doors kOneDoor{{30, 51}};  // 1.05 m, its middle at y = kMiddle_m

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

/// A mate stood in the door after the robot had come through: it stays in the map.
struct HallWithStander : Hall {
  HallWithStander() : Hall(kOneDoor) {
    for (int x = 76; x < 84; ++x) {
      for (int y = 36; y < 45; ++y) cells.put({x, y}, 5, 5);
    }
    for (double x = 0.1; x < 7.0; x += 0.5) way.push_back(stands_at(x, kMiddle_m));
    for (double x = 3.0; x < 5.0; x += 0.025) seen.emplace_back(x, kMiddle_m);
  }
  std::vector<Vector2> seen;
};

TEST(RouteMap, AWayThatIsSeenToBeFreeIsOpenWhateverTheMapSays) {
  HallWithStander hall;
  EXPECT_FALSE(hall.has_way_through()) << "who stood there stands there";
  hall.overlays.seen_through = hall.seen;
  EXPECT_TRUE(hall.has_way_through());
  hall.overlays.seen_now = {{4.025, Hall::kMiddle_m + 0.15}};
  EXPECT_FALSE(hall.has_way_through()) << "what the same scan sees beside it";
}

TEST(RouteMap, WhatSonarHeardKeepsClosedWhatLooksFree) {
  HallWithStander hall;
  hall.overlays.seen_through = hall.seen;
  hall.overlays.echoed = {{4.025, Hall::kMiddle_m}};
  EXPECT_FALSE(hall.has_way_through()) << "a shut door of glass";
}

TEST(RouteMap, WhatTheScanSeesAtACellKeepsIt) {
  HallWithStander hall;
  hall.overlays.seen_through = hall.seen;
  RoutesIn open(hall, stands_at(1.5, Hall::kMiddle_m));
  const CellIndex cell = open.map().cell_at({4.025, Hall::kMiddle_m});
  EXPECT_EQ(open.map().state(cell), CellState::kFree);
  hall.overlays.seen_now = {{4.025, Hall::kMiddle_m + 0.08}};
  RoutesIn kept(hall, stands_at(1.5, Hall::kMiddle_m));
  EXPECT_EQ(kept.map().state(cell), CellState::kOccupied);
}

/// Between its scanner and its centre a robot no longer sees what it was let onto.
TEST(RouteMap, ARobotLeavesWhereItStandsWhateverTheMapSays) {
  HallWithStander hall;
  EXPECT_FALSE(hall.route({4.025, Hall::kMiddle_m}, {3.5, Hall::kMiddle_m}).empty());
  hall.area.keep_out = {{{3.8, 1.0}, {4.2, 1.0}, {4.2, 3.0}, {3.8, 3.0}}};
  RoutesIn kept(hall, stands_at(4.025, Hall::kMiddle_m));
  EXPECT_EQ(kept.map().state(kept.map().cell_at({4.025, Hall::kMiddle_m})), CellState::kOccupied);
}

TEST(RouteMap, WhatOnePeriodSawToBeFreeIsClosedInTheNext) {
  HallWithStander hall;
  RoutesIn map(hall, stands_at(1.5, Hall::kMiddle_m));
  const grid::DenseMap before = map.map();
  Overlays overlays;
  overlays.seen_through = hall.seen;
  for (int period = 0; period < 2; ++period) {
    map.begin(stands_at(1.5, Hall::kMiddle_m), hall.ways(), overlays);
    EXPECT_NE(map.map().cells, before.cells);
    map.take(1, hall.cells.grid(), hall.ways());
    EXPECT_EQ(map.map().cells, before.cells) << "an analysis gets the map alone";
    map.begin(stands_at(1.5, Hall::kMiddle_m), hall.ways(), {});
    EXPECT_TRUE(map.route_to(map.map().cell_at({6.5, Hall::kMiddle_m})).empty());
  }
}

TEST(RouteMap, WhatIsKeptOutOfStaysClosedHoweverFreeItLooks) {
  HallWithStander hall;
  hall.overlays.seen_through = hall.seen;
  hall.area.keep_out = {{{3.8, 1.0}, {4.2, 1.0}, {4.2, 3.0}, {3.8, 3.0}}};
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
