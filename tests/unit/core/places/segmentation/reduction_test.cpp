// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/reduction.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "core/grid/clearance_update.hpp"
#include "tests/unit/core/places/drawn_map.hpp"
#include "tests/unit/core/places/patches.hpp"

namespace topo::places {
namespace {

TEST(BoxCounts, AreExactOnWholeBins) {
  EXPECT_TRUE(rc::check([] {
    DrawnMap drawn(30, 24);
    for (int y = 0; y < 24; ++y) {
      for (int x = 0; x < 30; ++x)
        drawn.fill(
            x, y, x + 1, y + 1,
            *rc::gen::element(grid::CellState::kUnknown, grid::CellState::kFree, grid::CellState::kOccupied));
    }
    const BoxCounts counts(drawn.map(), CompassFrame(0.0));
    // Bins begin at the array's corner, cell (-1, -1).
    const int x0 = 2 * *rc::gen::inRange(0, 14) - 1, x1 = x0 + 2 * *rc::gen::inRange(0, 8);
    const int y0 = 2 * *rc::gen::inRange(0, 11) - 1, y1 = y0 + 2 * *rc::gen::inRange(0, 8);
    std::uint32_t expected = 0;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) expected += drawn.map().state({x, y}) == grid::CellState::kOccupied;
    }
    RC_ASSERT(counts.occupied_in({{x0 * 0.05, y0 * 0.05}, {x1 * 0.05, y1 * 0.05}}) == expected);
  }));
}

TEST(BoxCounts, OfATurnedFrameCountEveryCellOnce) {
  const DrawnMap drawn = DrawnMap(61, 37).free(3, 4, 40, 30).occupied(10, 10, 12, 20);
  for (const double compass_rad : {0.1, 0.7, 1.2, 1.55}) {
    const BoxCounts counts(drawn.map(), CompassFrame(compass_rad));
    EXPECT_EQ(counts.occupied_in({{-1e3, -1e3}, {1e3, 1e3}}), 20U);
  }
}

TEST(Density, WeighsWhatLiesInTheBox) {
  // 40 x 20 cells: half free and the region's own, a quarter occupied, a quarter unknown.
  const DrawnMap drawn = DrawnMap(41, 21).free(1, 1, 21, 21).occupied(21, 1, 31, 21);
  const BoxCounts counts(drawn.map(), CompassFrame(0.0));
  const types::Rectangle box{{0.05, 0.05}, {41 * 0.05, 21 * 0.05}};
  PlaceParams params;
  params.density.elsewhere_weight = 0.3;
  EXPECT_NEAR(density(box, 400, counts, 0.05, params), 400.0 / (400 + 200 + 0.3 * 200), 1e-9);
  EXPECT_NEAR(density(box, 200, counts, 0.05, params), 200.0 / (200 + 200 + 0.3 * 400), 1e-9);
}

TEST(Conditions, ACorridorIsAsLongAndNarrowAsSaid) {
  Region region;
  region.clearance_m = 1.0F;
  region.core = {{0.0, 0.0}, {5.0, 2.0}};
  EXPECT_TRUE(is_corridor(region, {}));
  EXPECT_FALSE(is_corridor(region, {.length_ratio = 3.0, .clearance_ratio = 0.7, .alongside_ratio = 1.5}));
  EXPECT_FALSE(is_corridor(region, {.length_ratio = 2.0, .clearance_ratio = 0.4, .alongside_ratio = 1.5}));
}

TEST(Conditions, AreWhatTheySay) {
  const PlaceParams params;
  Contact door{1, 18, 0, 0.0F, 0.45F};  // 0.9 m
  Region corridor, room;
  corridor.clearance_m = 1.0F;
  corridor.core = {{0.0, 0.0}, {10.0, 2.0}};
  room.clearance_m = 2.5F;
  room.core = {{0.0, 2.0}, {5.0, 7.0}};
  EXPECT_FALSE(no_narrows(corridor, room, door, 0.05, params));
  EXPECT_TRUE(no_narrows(corridor, room, {1, 40, 0, 0.0F, 1.0F}, 0.05, params)) << "the corridor's width";
  EXPECT_TRUE(no_narrows(corridor, room, {1, 60, 0, 0.0F, 0.0F, 60.0F}, 0.05, params)) << "in several parts";
  EXPECT_FALSE(no_narrows(corridor, room, {1, 60, 0, 0.0F, 0.0F, 18.0F}, 0.05, params))
      << "all of it behind a door";
  Contact end{1, 0, 40, 0.0F, 1.0F}, side{1, 200, 0, 0.0F, 1.0F};
  EXPECT_FALSE(similar_width(corridor, room, end, 0.05, params));
  EXPECT_TRUE(similar_width(corridor, room, side, 0.05, params)) << "the edge of a hall";
  EXPECT_TRUE(similar_width(corridor, corridor, end, 0.05, params));
  EXPECT_TRUE(no_wall_between(door, 0.05, params));
  door.wall_m = 1.0F;
  EXPECT_FALSE(no_wall_between(door, 0.05, params));
}

}  // namespace
}  // namespace topo::places
