// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/continued_walls.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

#include "core/types/se2.hpp"
#include "tests/unit/core/places/drawn_map.hpp"
#include "tests/unit/core/places/patches.hpp"

namespace topo::goals {
namespace {

using grid::CellState;
using places::DrawnMap;
using types::Segment;

constexpr ContinuedWallParams kFar{.length_m = 9.0};

TEST(ContinuedWalls, EndBeforeTheFirstFreeCell) {
  const grid::DenseMap map = DrawnMap(200, 40).free(150, 0, 160, 40).map();
  const auto continued = continued_walls(map, std::vector<Segment>{{{1.0, 1.0}, {3.0, 1.0}}}, kFar);
  ASSERT_EQ(continued.size(), 2U);
  EXPECT_EQ(continued[1].a, types::Vector2(3.0, 1.0));
  EXPECT_NEAR(continued[1].b.x(), 7.5, 0.051) << "before what is free from 7.5 m on";
  EXPECT_EQ(continued[0].a, types::Vector2(1.0, 1.0));
  EXPECT_NEAR(continued[0].b.x(), -8.0, 1e-9) << "beyond the map's border, too";
  EXPECT_NEAR(continued[0].b.y(), 1.0, 1e-9);
}

TEST(ContinuedWalls, GoOnOverFreeCellsAtTheirEndsOnly) {
  const grid::DenseMap map = DrawnMap(200, 40).free(60, 0, 66, 40).free(100, 0, 106, 40).map();
  const auto continued = continued_walls(map, std::vector<Segment>{{{1.0, 1.0}, {3.0, 1.0}}}, kFar);
  EXPECT_NEAR(continued[1].b.x(), 5.0, 0.051) << "over 0.3 m at once, not 2 m on";
}

TEST(ContinuedWalls, AreAsLongAsTheParameterSays) {
  const std::vector<Segment> wall{{{40.0, 1.0}, {41.0, 1.0}}};
  const grid::DenseMap map = DrawnMap(2000, 40).map();
  for (const Segment& on : continued_walls(map, wall)) EXPECT_NEAR(on.length_m(), 1.2, 1e-9);
  for (const Segment& on : continued_walls(map, wall, kFar)) EXPECT_NEAR(on.length_m(), 9.0, 1e-9);
}

TEST(ContinuedWalls, OfNoWallAreNone) {
  const grid::DenseMap map = DrawnMap(200, 40).map();
  EXPECT_TRUE(continued_walls(map, std::vector<Segment>{{{1.0, 1.0}, {1.0, 1.0}}}).empty()) << "no direction";
  EXPECT_TRUE(continued_walls(map, {}).empty());
}

/// Whatever the map and the wall: straight on from its ends, and over nothing that is free but the jamb.
TEST(ContinuedWalls, LieInTheirWallsLineOverWhatIsNotFree) {
  EXPECT_TRUE(rc::check([] {
    grid::DenseMap map = DrawnMap(100, 100).map();
    places::draw_patches(map, *rc::gen::inRange(0, 30), 20);
    const auto point = [] {
      return types::Vector2(0.01 * *rc::gen::inRange(0, 500), 0.01 * *rc::gen::inRange(0, 500));
    };
    const Segment wall{point(), point()};
    const ContinuedWallParams params;
    const auto continued = continued_walls(map, std::vector<Segment>{wall}, params);
    if (wall.a == wall.b) {
      RC_ASSERT(continued.empty());
      return;
    }
    RC_ASSERT(continued.size() == 2U);
    RC_ASSERT(continued[0].a == wall.a && continued[1].a == wall.b);
    const types::Vector2 along = (wall.b - wall.a).normalized();
    for (const Segment& on : continued) {
      const types::Vector2 way = on.b - on.a;
      RC_ASSERT(std::abs(way.x() * along.y() - way.y() * along.x()) < 1e-6);
      RC_ASSERT((on.a == wall.a ? -1.0 : 1.0) * way.dot(along) >= 0.0);
      RC_ASSERT(way.norm() <= params.length_m + 1e-9);
      for (int k = 1; k * map.resolution_m <= way.norm(); ++k) {
        const double at_m = k * map.resolution_m;
        if (at_m > params.jamb_m)
          RC_ASSERT(map.state(map.cell_at(on.a + at_m / way.norm() * way)) != CellState::kFree);
      }
    }
  }));
}

}  // namespace
}  // namespace topo::goals
