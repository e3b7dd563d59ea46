// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <vector>

#include "core/travel/route_map.hpp"
#include "tests/unit/core/travel/hall.hpp"

// Where an obstacle of the map is gone.
namespace topo::travel {
namespace {

using grid::CellIndex;
using grid::CellState;
using types::Vector2;

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

TEST(RouteMapOpened, AWayThatIsSeenToBeFreeIsOpenWhateverTheMapSays) {
  HallWithStander hall;
  EXPECT_FALSE(hall.has_way_through()) << "who stood there stands there";
  hall.overlays.seen_through = hall.seen;
  EXPECT_TRUE(hall.has_way_through());
  hall.overlays.seen_now = {{4.025, Hall::kMiddle_m + 0.15}};
  EXPECT_FALSE(hall.has_way_through()) << "what the same scan sees beside it";
}

TEST(RouteMapOpened, WhatSonarHeardKeepsClosedWhatLooksFree) {
  HallWithStander hall;
  hall.overlays.seen_through = hall.seen;
  hall.overlays.echoed = {{4.025, Hall::kMiddle_m}};
  EXPECT_FALSE(hall.has_way_through()) << "a shut door of glass";
}

TEST(RouteMapOpened, WhatTheScanSeesAtACellKeepsIt) {
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
TEST(RouteMapOpened, ARobotLeavesWhereItStandsWhateverTheMapSays) {
  HallWithStander hall;
  EXPECT_FALSE(hall.route({4.025, Hall::kMiddle_m}, {3.5, Hall::kMiddle_m}).empty());
  hall.area.keep_out = {{{3.8, 1.0}, {4.2, 1.0}, {4.2, 3.0}, {3.8, 3.0}}};
  RoutesIn kept(hall, stands_at(4.025, Hall::kMiddle_m));
  EXPECT_EQ(kept.map().state(kept.map().cell_at({4.025, Hall::kMiddle_m})), CellState::kOccupied);
}

TEST(RouteMapOpened, WhatOnePeriodSawToBeFreeIsClosedInTheNext) {
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

TEST(RouteMapOpened, WhatIsKeptOutOfStaysClosedHoweverFreeItLooks) {
  HallWithStander hall;
  hall.overlays.seen_through = hall.seen;
  hall.area.keep_out = {{{3.8, 1.0}, {4.2, 1.0}, {4.2, 3.0}, {3.8, 3.0}}};
  EXPECT_FALSE(hall.has_way_through());
}

}  // namespace
}  // namespace topo::travel
