// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/fresh/doors.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace topo::bench::fresh {
namespace {

/// Two rooms on a corridor, and a third room that touches the second alone.
Wing three_rooms() {
  Wing wing;
  wing.wall_m = 0.2;
  wing.outline = {0.0, 0.0, 12.0, 8.0};
  wing.spaces = {{{0.0, 0.0, 8.0, 2.0}, Use::kCorridor},
                 {{0.0, 2.0, 4.0, 8.0}, Use::kRoom},
                 {{4.0, 2.0, 8.0, 8.0}, Use::kRoom},
                 {{8.0, 2.0, 12.0, 8.0}, Use::kRoom}};
  return wing;
}

bool joins(const Door& door, std::size_t a, std::size_t b) {
  return (door.a == a && door.b == b) || (door.a == b && door.b == a);
}

std::size_t doors_between(const Wing& wing, std::size_t a, std::size_t b) {
  return static_cast<std::size_t>(std::count_if(wing.doors.begin(), wing.doors.end(),
                                                [&](const Door& door) { return joins(door, a, b); }));
}

constexpr DoorRules kFewDoors{0.0, 0.0, 0.0, 0.0, 0.0, 0.0};

TEST(Doors, findsTheWallsThatTwoSpacesShare) {
  const auto walls = shared_walls(three_rooms());
  ASSERT_EQ(walls.size(), 4U);
  for (const SharedWall& wall : walls) {
    if (wall.a != 1 || wall.b != 2) continue;
    EXPECT_TRUE(wall.along_x);
    EXPECT_DOUBLE_EQ(wall.wall_at_m, 4.0);
    EXPECT_DOUBLE_EQ(wall.from_m, 2.2) << "behind the wall below";
    EXPECT_DOUBLE_EQ(wall.to_m, 8.0);
  }
}

TEST(Doors, openRoomsToTheCorridorAndThenTheRest) {
  for (std::uint64_t seed = 1; seed < 50; ++seed) {
    Wing wing = three_rooms();
    sim::Random random(seed);
    add_doors(wing, kFewDoors, random);
    EXPECT_EQ(doors_between(wing, 0, 1), 1U);
    EXPECT_EQ(doors_between(wing, 0, 2), 1U);
    EXPECT_EQ(doors_between(wing, 2, 3), 1U) << "there is no other way into the last";
    EXPECT_EQ(doors_between(wing, 1, 2), 0U);
  }
}

TEST(Doors, closeWhatCannotBeReached) {
  Wing wing = three_rooms();
  wing.spaces[2].use = Use::kClosed;
  sim::Random random(1);
  add_doors(wing, kFewDoors, random);
  EXPECT_EQ(wing.spaces[3].use, Use::kClosed) << "behind the closed one";
  EXPECT_EQ(wing.spaces[1].use, Use::kRoom);
}

TEST(Doors, standInTheWallAndBetweenItsEnds) {
  for (std::uint64_t seed = 1; seed < 50; ++seed) {
    Wing wing = three_rooms();
    sim::Random random(seed);
    add_doors(wing, DoorRules{0.5, 1.0, 1.0, 0.0, 0.0, 0.0}, random);
    for (const Door& door : wing.doors) {
      const Box a = floor_of(wing.spaces[door.a], wing.wall_m),
                b = floor_of(wing.spaces[door.b], wing.wall_m);
      EXPECT_FALSE(overlap(grown(door.gap, -1e-6), a));
      EXPECT_FALSE(overlap(grown(door.gap, -1e-6), b));
      EXPECT_TRUE(overlap(grown(door.gap, 1e-6), a));
      EXPECT_TRUE(overlap(grown(door.gap, 1e-6), b));
    }
  }
}

}  // namespace
}  // namespace topo::bench::fresh
