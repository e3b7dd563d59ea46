// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/fresh/layouts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "tests/bench/topobench/fresh/doors.hpp"
#include "tests/bench/topobench/fresh/furnish.hpp"
#include "tests/bench/topobench/fresh/room_floor.hpp"
#include "tests/bench/topobench/fresh/wings.hpp"

namespace topo::bench::fresh {
namespace {

using Layout = std::function<std::vector<Space>(const Box&, const LayoutRules&, sim::Random&)>;

/// The spaces fill their block: none overlap, and the areas add up.
void expect_partition(const Layout& layout, const Box& block) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    sim::Random random(seed);
    const LayoutRules rules = seed % 2 == 0 ? office_rules(random) : house_rules(random);
    const std::vector<Space> spaces = layout(block, rules, random);
    double area_m2 = 0.0;
    for (std::size_t i = 0; i < spaces.size(); ++i) {
      area_m2 += spaces[i].box.area_m2();
      EXPECT_GT(std::min(spaces[i].box.width(), spaces[i].box.height()), 1.0) << "seed " << seed;
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_FALSE(overlap(grown(spaces[i].box, -1e-6), spaces[k].box)) << "seed " << seed;
    }
    EXPECT_NEAR(area_m2, block.area_m2(), 1e-6) << "seed " << seed;
  }
}

TEST(Layouts, fillTheBlock) {
  for (const Box& block : {Box{0.0, 0.0, 30.0, 14.0}, Box{0.0, 0.0, 50.0, 42.0}, Box{0.0, 0.0, 24.0, 36.0}}) {
    expect_partition(office_layout, block);
    expect_partition(hall_layout, block);
  }
  expect_partition(ring_layout, {0.0, 0.0, 46.0, 34.0});
}

TEST(Layouts, putACorridorAroundTheCore) {
  sim::Random random(3);
  const std::vector<Space> spaces = ring_layout({0.0, 0.0, 46.0, 34.0}, office_rules(random), random);
  EXPECT_GE(
      std::count_if(spaces.begin(), spaces.end(), [](const Space& s) { return s.use == Use::kCorridor; }), 4);
}

TEST(Wings, seeWhetherOutlinesOverlap) {
  const sim::Polygon square = corners({0.0, 0.0, 2.0, 2.0});
  EXPECT_TRUE(convex_overlap(square, corners({1.0, 1.0, 3.0, 3.0})));
  EXPECT_FALSE(convex_overlap(square, corners({2.5, 0.0, 3.0, 3.0})));
  const sim::Polygon diamond = sim::transformed(corners({-1.0, -1.0, 1.0, 1.0}), {3.2, 3.2, 0.785398});
  EXPECT_FALSE(convex_overlap(square, diamond)) << "their bounding boxes overlap, they do not";
}

TEST(Furniture, standsInItsRoomAndBeforeNoDoor) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    sim::Random random(seed);
    Wing wing;
    wing.outline = {0.0, 0.0, 40.0, 16.0};
    wing.spaces = office_layout(wing.outline, office_rules(random), random);
    add_doors(wing, {}, random);
    furnish(wing, {1.0, 1.5, true, false}, random);
    for (const Piece& piece : wing.pieces) {
      const Box floor = grown(floor_of(wing.spaces[piece.space], wing.wall_m), 1e-6);
      for (const sim::Vector2& p : piece.outline) {
        EXPECT_TRUE(floor.contains(p)) << "seed " << seed;
        for (const Door& door : wing.doors) {
          const bool of_the_room = door.a == piece.space || door.b == piece.space;
          EXPECT_FALSE(of_the_room && grown(door.gap, 0.1).contains(p)) << "seed " << seed;
        }
      }
    }
  }
}

TEST(RoomFloor, takesNoSecondPieceOnTheFirst) {
  Wing wing;
  wing.wall_m = 0.2;
  wing.spaces = {{{0.0, 0.0, 5.0, 4.0}, Use::kRoom}};
  RoomFloor room(wing, 0);
  EXPECT_TRUE(room.put(Box{1.0, 1.0, 2.0, 2.0}));
  EXPECT_FALSE(room.put(Box{1.5, 1.5, 2.5, 2.5}));
  EXPECT_TRUE(room.put(Box{2.0, 1.0, 3.0, 2.0})) << "beside it";
  EXPECT_FALSE(room.put(Box{0.1, 3.0, 1.0, 3.5})) << "in the wall";
  EXPECT_EQ(wing.pieces.size(), 2U);
}

}  // namespace
}  // namespace topo::bench::fresh
