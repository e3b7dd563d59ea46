// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/walls/wall_store.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <map>
#include <optional>

namespace topo::walls {
namespace {

std::map<patricia::Key, Slabs> columns_of(const WallStore& store) {
  std::map<patricia::Key, Slabs> out;
  store.columns().for_each([&](patricia::Key key, Slabs slabs) { out[key] = slabs; });
  return out;
}

TEST(WallStore, IsAMapOfSlabsInWhichAddingUnites) {
  EXPECT_TRUE(rc::check([] {
    patricia::Arena<Slabs> arena;
    WallStore store(arena, 0.05);
    std::map<patricia::Key, Slabs> expected, at_snapshot;
    std::optional<WallStore> snapshot;
    for (int steps = *rc::gen::inRange(0, 60); steps > 0; --steps) {
      const patricia::Key cell = patricia::cell_key(*rc::gen::inRange(-3, 4), *rc::gen::inRange(-3, 4));
      const Slabs slabs = *rc::gen::element(0U, 1U, 5U, 1U << 31);
      if (*rc::gen::arbitrary<bool>()) {
        store.set(cell, slabs);
        expected[cell] = slabs;
        if (slabs == 0) expected.erase(cell);
      } else if (slabs != 0) {
        store.add(cell, slabs);
        expected[cell] |= slabs;
      }
      if (steps == 20) {
        snapshot.emplace(store);
        at_snapshot = expected;
      }
    }
    RC_ASSERT(columns_of(store) == expected);
    if (snapshot) RC_ASSERT(columns_of(*snapshot) == at_snapshot);
  }));
}

TEST(WallStore, PointsOfOneCellHaveItsKeyOnBothSidesOfZero) {
  EXPECT_TRUE(rc::check([] {
    patricia::Arena<Slabs> arena;
    const WallStore store(arena, 0.125);
    EXPECT_EQ(store.resolution_m(), 0.125);
    const int x = *rc::gen::inRange(-500, 500), y = *rc::gen::inRange(-500, 500);
    const auto inside = [](int cell) { return (cell + *rc::gen::inRange(0, 1000) * 1e-3) * 0.125; };
    const double x_m = inside(x), y_m = inside(y);
    RC_ASSERT(store.cell_at({x_m, y_m}) == patricia::cell_key(x, y));
    RC_ASSERT(store.cell_at({x_m + 0.125, y_m}) == patricia::cell_key(x + 1, y));
    RC_ASSERT(store.cell_at({x_m, y_m - 0.125}) == patricia::cell_key(x, y - 1));
  }));
}

}  // namespace
}  // namespace topo::walls
