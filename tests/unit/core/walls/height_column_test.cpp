// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/walls/height_column.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <vector>

#include "core/walls/wall_store.hpp"

namespace topo::walls {
namespace {

/// The definition, word by word: three set slabs, neighbouring ones at least five slabs apart.
bool is_wall_by_trying(Slabs slabs) {
  for (int a = 0; a < kSlabs; ++a) {
    for (int b = a + 5; b < kSlabs; ++b) {
      for (int c = b + 5; c < kSlabs; ++c) {
        if (((slabs >> a) & (slabs >> b) & (slabs >> c) & 1U) != 0) return true;
      }
    }
  }
  return false;
}

TEST(SlabOf, CountsTenthsOfAMetreFromTheFloor) {
  EXPECT_EQ(slab_of(0.05), 1U);
  EXPECT_EQ(slab_of(0.15), 2U);
  EXPECT_EQ(slab_of(3.19), 1U << 31);
  EXPECT_EQ(slab_of(3.2), 0U);
  EXPECT_EQ(slab_of(-0.01), 0U);
}

TEST(IsWall, NeedsThreeHeightsHalfAMetreApart) {
  const auto heights = [](std::vector<double> list) {
    Slabs slabs = 0;
    for (const double h : list) slabs |= slab_of(h);
    return slabs;
  };
  EXPECT_TRUE(is_wall(heights({0.35, 0.85, 1.35})));
  EXPECT_FALSE(is_wall(heights({0.35, 0.85, 1.25})));
  EXPECT_FALSE(is_wall(heights({0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8})));  // a box, 0.8 m high
  EXPECT_FALSE(is_wall(0));
  EXPECT_TRUE(is_wall(~Slabs{0}));
}

TEST(IsWall, NeedsAsManyHeightsAsFarApartAsSaid) {
  const Slabs low = slab_of(0.35) | slab_of(0.65);
  EXPECT_TRUE(is_wall(low, {.count_min = 2, .apart_slabs = 3}));
  EXPECT_FALSE(is_wall(low, {.count_min = 2, .apart_slabs = 4}));
  EXPECT_FALSE(is_wall(low, {.count_min = 3, .apart_slabs = 3}));
}

TEST(IsWall, AgreesWithItsDefinition) {
  EXPECT_TRUE(rc::check("greedy choice from below finds three heights iff there are three", [] {
    const Slabs slabs =
        *rc::gen::arbitrary<Slabs>() & *rc::gen::arbitrary<Slabs>() & *rc::gen::arbitrary<Slabs>();
    RC_ASSERT(is_wall(slabs) == is_wall_by_trying(slabs));
  }));
}

TEST(SlabOf, EachHeightUpToTheHighestIsInOneSlab) {
  EXPECT_TRUE(rc::check([] {
    const int tenth = *rc::gen::inRange(-40, 60);
    const double height_m = 0.1 * tenth + 1e-4 * *rc::gen::inRange(1, 1000);
    const Slabs slab = slab_of(height_m);
    RC_ASSERT(slab == (tenth >= 0 && tenth < kSlabs ? Slabs{1} << tenth : Slabs{0}));
  }));
  EXPECT_EQ(slab_of(std::nan("")), 0U);
  EXPECT_EQ(slab_of(HUGE_VAL), 0U);
}

TEST(IsWall, StaysAWallWhenMoreIsSeen) {
  EXPECT_TRUE(rc::check([] {
    const int low = *rc::gen::inRange(0, 22), middle = *rc::gen::inRange(low + 5, 27);
    const int high = *rc::gen::inRange(middle + 5, 32);
    const Slabs three = Slabs{1} << low | Slabs{1} << middle | Slabs{1} << high;
    RC_ASSERT(is_wall(three));
    RC_ASSERT(is_wall(three | *rc::gen::arbitrary<Slabs>()));
    for (const int one : {low, middle, high}) RC_ASSERT(!is_wall(three & ~(Slabs{1} << one)));
  }));
}

TEST(WallStore, SeeingAThingTwiceDoesNotEraseIt) {
  patricia::Arena<Slabs> arena;
  WallStore store(arena, 0.05);
  store.add(store.cell_at({1.02, -0.03}), 0b0101U);
  store.add(store.cell_at({1.03, -0.02}), 0b0001U);
  store.add(store.cell_at({1.03, -0.02}), 0b1000U);
  ASSERT_EQ(store.columns().size(), 1U);
  const Slabs* slabs = store.columns().find(patricia::cell_key(20, -1));
  ASSERT_NE(slabs, nullptr);
  EXPECT_EQ(*slabs, 0b1101U);
}

}  // namespace
}  // namespace topo::walls
