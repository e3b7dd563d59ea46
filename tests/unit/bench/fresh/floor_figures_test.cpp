// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/fresh/floor_figures.hpp"

#include <gtest/gtest.h>

namespace topo::bench::fresh {
namespace {

void carve(sim::Raster& free, int x0, int y0, int x1, int y1, std::uint8_t value = 1) {
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) free.set(x, y, value);
  }
}

/// Two rooms of 4 m, and a door of 18 cells, 0.9 m, between them.
sim::Raster two_rooms() {
  sim::Raster free(0.05, {0.0, 0.0}, 200, 100);
  carve(free, 5, 5, 85, 85);
  carve(free, 90, 5, 170, 85);
  carve(free, 85, 40, 90, 58);
  return free;
}

TEST(FloorFigures, measuresTheDoorBetweenTwoRooms) {
  const FloorFigures figures = floor_figures(two_rooms(), {1.0, 1.0});
  ASSERT_EQ(figures.doors_m.size(), 1U);
  EXPECT_NEAR(figures.doors_m.front(), 0.9, 0.051);
  EXPECT_NEAR(figures.floor_m2, 2.0 * 16.0 + 0.25 * 0.9, 0.7);
  EXPECT_DOUBLE_EQ(figures.pieces_per_100m2, 0.0);
}

TEST(FloorFigures, takesNoWideOpeningForADoor) {
  sim::Raster free = two_rooms();
  carve(free, 85, 10, 90, 80);
  EXPECT_TRUE(floor_figures(free, {1.0, 1.0}).doors_m.empty());
}

TEST(FloorFigures, countsWhatStandsFree) {
  sim::Raster free = two_rooms();
  carve(free, 30, 30, 40, 40, 0);
  carve(free, 120, 20, 124, 24, 0);
  carve(free, 5, 70, 25, 85, 0);  // at a wall: a part of it
  const FloorFigures figures = floor_figures(free, {0.7, 0.7});
  EXPECT_NEAR(figures.pieces_per_100m2 * figures.floor_m2 / 100.0, 2.0, 1e-9);
  EXPECT_NEAR(figures.furnished_share, (0.25 + 0.04) / figures.floor_m2, 0.001);
}

TEST(FloorFigures, findsTheQuantileOfValues) {
  EXPECT_DOUBLE_EQ(quantile({3.0, 1.0, 2.0}, 0.5), 2.0);
  EXPECT_DOUBLE_EQ(quantile({3.0, 1.0, 2.0}, 1.0), 3.0);
  EXPECT_DOUBLE_EQ(quantile({}, 0.5), 0.0);
}

}  // namespace
}  // namespace topo::bench::fresh
