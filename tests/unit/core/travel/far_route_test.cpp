// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/travel/far_route.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "core/grid/distance.hpp"
#include "tests/unit/core/grid/maps.hpp"

namespace topo::travel {
namespace {

using grid::CellIndex;
using grid::CellState;

/// Rooms of 4 by 4 m side by side and one above the other, in cells of 0.05 m, with doors of 1 m somewhere in
/// most of the walls between them.
CoarseMap arbitrary_building() {
  constexpr int kRooms = 4, kRoom = 80, kDoor = 20;
  CoarseMap building;
  grid::DenseMap& map = building.map;
  map = grid::filled_map(kRooms * kRoom, kRooms * kRoom, CellState::kFree);
  const auto wall = [&](int x, int y) { map.cells[map.index({x, y})] = CellState::kOccupied; };
  for (int line = 0; line <= kRooms; ++line) {
    for (int room = 0; room < kRooms; ++room) {
      const bool inside = line > 0 && line < kRooms;
      for (const bool upright : {false, true}) {
        const int door =
            inside && *rc::gen::inRange(0, 4) != 0 ? *rc::gen::inRange(5, kRoom - kDoor - 5) : -kDoor;
        for (int i = 0; i < kRoom; ++i) {
          if (i >= door && i < door + kDoor) continue;
          const int along = room * kRoom + i, across = std::min(line * kRoom, kRooms * kRoom - 1);
          upright ? wall(across, along) : wall(along, across);
        }
      }
    }
  }
  building.clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
  return building;
}

CellIndex arbitrary_cell() {
  const auto coordinate = [] { return 80 * *rc::gen::inRange(0, 4) + *rc::gen::inRange(12, 70); };
  const int x = coordinate();
  return {x, coordinate()};
}

double length_cells(const std::vector<CellIndex>& route) {
  double length = 0.0;
  for (std::size_t i = 1; i < route.size(); ++i)
    length += std::hypot(route[i].x - route[i - 1].x, route[i].y - route[i - 1].y);
  return length;
}

TEST(FarRoute, isAsShortAsThatOfASearchOfTheWholeBuilding) {
  EXPECT_TRUE(rc::check([] {
    const CoarseMap fine = arbitrary_building();
    const CoarseMap coarse = coarser(fine.map, fine.clearance_m, 2);
    const CellIndex start = arbitrary_cell(), target = arbitrary_cell();
    const auto coarse_field =
        grid::travel_field(coarse.map, coarse.clearance_m, coarse.map.cell_at(fine.map.centre_of(start)), {});
    const grid::TravelField whole = grid::travel_field(fine.map, fine.clearance_m, start, {});
    FarRoute far;
    const auto route = far.find(fine.map, fine.clearance_m, coarse, coarse_field, start, target, {}, {});
    const auto best = grid::route_to(fine.map, whole, target);
    RC_ASSERT(route.empty() == best.empty());
    if (best.empty()) return;
    RC_ASSERT(route.front() == start);
    RC_ASSERT(route.back() == target);
    RC_ASSERT(length_cells(route) <= 1.02 * length_cells(best) + 4.0);
    for (const CellIndex& cell : route) RC_ASSERT(!std::isinf(whole.cost_m[fine.map.index(cell)]));
  }));
}

/// A door in which the robot cannot turn, and 6 m aside a wide one. Where the wall lies in the coarse cells
/// decides what those know of it.
TEST(FarRoute, doesNotLeadThroughATightDoorBesideAWideOne) {
  const grid::TravelRules rules{.radius_m = 0.28, .tight_m = 0.24};
  const auto add_wall = [](grid::DenseMap& map, int x) {
    for (int y = 0; y < 300; ++y) {
      const bool tight = y >= 95 && y < 105, wide = y >= 220 && y < 245;
      if (!tight && !wide) map.cells[map.index({x, y})] = CellState::kOccupied;
    }
  };
  for (const int wall_x : {200, 201, 202, 203}) {
    CoarseMap fine;
    fine.map = grid::filled_map(400, 300, CellState::kFree);
    add_wall(fine.map, wall_x);
    fine.clearance_m = grid::clearance_m(fine.map, grid::Boundary::kOccupiedOrUnknown);
    const CoarseMap coarse = coarser(fine.map, fine.clearance_m, 2);
    const CellIndex start{150, 100}, target{250, 100};
    const auto coarse_field = grid::travel_field(coarse.map, coarse.clearance_m,
                                                 coarse.map.cell_at(fine.map.centre_of(start)), rules);
    FarRoute far;
    const auto route = far.find(fine.map, fine.clearance_m, coarse, coarse_field, start, target, rules, {});
    for (const CellIndex& cell : route) EXPECT_TRUE(cell.x != wall_x || cell.y >= 220) << wall_x;
  }
}

TEST(FarRoute, isNoneWhereTheCoarseMapHasNone) {
  CoarseMap fine;
  fine.map = grid::filled_map(100, 60, CellState::kFree);
  for (int y = 0; y < 60; ++y) fine.map.cells[fine.map.index({50, y})] = CellState::kOccupied;
  fine.clearance_m = grid::clearance_m(fine.map, grid::Boundary::kOccupiedOrUnknown);
  const CoarseMap coarse = coarser(fine.map, fine.clearance_m, 2);
  const auto coarse_field = grid::travel_field(coarse.map, coarse.clearance_m, {5, 7}, {});
  FarRoute far;
  EXPECT_TRUE(far.find(fine.map, fine.clearance_m, coarse, coarse_field, {20, 30}, {80, 30}, {}, {}).empty());
}

}  // namespace
}  // namespace topo::travel
