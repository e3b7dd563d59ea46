// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/bound/way_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/random.hpp"

namespace topo::bench::bound {
namespace {

/// 10 m by 10 m, with a wall at x = 5 that ends at y = 8.
sim::Raster places_with_wall() {
  sim::Raster places(0.05, {0.0, 0.0}, 200, 200, 1);
  for (int y = 0; y < 160; ++y) {
    for (int x = 98; x < 102; ++x) places.set(x, y, 0);
  }
  return places;
}

TEST(WayMap, isHardlyLongerThanTheStraightWay) {
  const WayMap map(sim::Raster(0.05, {0.0, 0.0}, 200, 200, 1));
  const sim::Vector2 from(5.05, 5.05);
  const WayMap::Field field = map.field_to({&from, 1});
  sim::Random random(1);
  for (int i = 0; i < 200; ++i) {
    const sim::Vector2 to(random.uniform(0.2, 9.8), random.uniform(0.2, 9.8));
    const double straight_m = (to - from).norm();
    EXPECT_LE(map.distance_m(field, to), WayMap::kLonger * straight_m + 0.15);
    EXPECT_GE(map.distance_m(field, to), straight_m - 0.15);
    EXPECT_NEAR(length_m(map.way(field, to)), straight_m, 0.15) << "the corners are cut";
  }
}

TEST(WayMap, leadsAroundAWall) {
  const WayMap map(places_with_wall());
  const sim::Vector2 from(4.0, 1.0), to(6.0, 1.0);
  const WayMap::Field field = map.field_to({&to, 1});
  const double around_m = std::hypot(0.9, 7.0) * 2.0 + 0.2;
  EXPECT_NEAR(length_m(map.way(field, from)), around_m, 0.3);
  for (const sim::Vector2& p : map.way(field, from)) EXPECT_NE(map.places().at(p), 0);
}

TEST(WayMap, hasNoWayIntoWhatIsShut) {
  sim::Raster places = places_with_wall();
  for (int y = 160; y < 200; ++y) {
    for (int x = 98; x < 102; ++x) places.set(x, y, 0);
  }
  const WayMap map(places);
  const sim::Vector2 to(6.0, 1.0);
  const WayMap::Field field = map.field_to({&to, 1});
  EXPECT_TRUE(std::isinf(map.distance_m(field, {4.0, 1.0})));
  EXPECT_TRUE(map.way(field, {4.0, 1.0}).empty());
}

}  // namespace
}  // namespace topo::bench::bound
