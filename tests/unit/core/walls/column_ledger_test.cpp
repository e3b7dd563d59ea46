// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/walls/column_ledger.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <map>
#include <vector>

namespace topo::walls {
namespace {

using Columns = std::vector<ColumnPoint>;

Columns any_columns() {
  Columns columns;
  for (int i = *rc::gen::inRange(0, 20); i > 0; --i) {
    columns.push_back({static_cast<float>(*rc::gen::inRange(-20, 20)) / 20.0F,
                       static_cast<float>(*rc::gen::inRange(-20, 20)) / 20.0F,
                       *rc::gen::inRange(Slabs{1}, Slabs{64})});
  }
  return columns;
}

types::Se2 any_pose() {
  const auto number = [] { return *rc::gen::inRange(-100, 100) / 100.0; };
  return {number(), number(), number()};
}

std::map<patricia::Key, Slabs> contents(const WallStore& store) {
  std::map<patricia::Key, Slabs> out;
  store.columns().for_each([&](patricia::Key key, Slabs slabs) { out[key] = slabs; });
  return out;
}

TEST(ColumnLedger, MovingIsAsIfTheyHadBeenDrawnThereAtOnce) {
  EXPECT_TRUE(rc::check("any columns from any poses", [] {
    patricia::Arena<Slabs> arena;
    WallStore moved(arena, 0.05), direct(arena, 0.05);
    ColumnLedger of_moved, of_direct;
    for (int i = *rc::gen::inRange(1, 5); i > 0; --i) {
      const Columns columns = any_columns();
      const types::Se2 first = any_pose(), between = any_pose(), last = any_pose();
      of_moved.draw(moved, columns, first);
      of_moved.move(moved, columns, first, between);
      of_moved.move(moved, columns, between, last);
      of_direct.draw(direct, columns, last);
    }
    RC_ASSERT(contents(moved) == contents(direct));
  }));
}

TEST(ColumnLedger, AnOlderVersionStaysAsItWas) {
  patricia::Arena<Slabs> arena;
  WallStore store(arena, 0.05);
  ColumnLedger ledger;
  const Columns columns{{1.0F, 0.0F, 7U}};
  ledger.draw(store, columns, {});
  const WallStore older = store;
  ledger.move(store, columns, {}, {3.0, 0.0, 0.0});
  EXPECT_EQ(contents(older).count(older.cell_at({1.01, 0.01})), 1U);
  EXPECT_EQ(contents(store).count(store.cell_at({1.01, 0.01})), 0U);
  EXPECT_EQ(contents(store).size(), 1U);
}

TEST(ColumnLedger, DrawsWhatIsDrawnWithoutOneAndStaysWithoutAMove) {
  EXPECT_TRUE(rc::check([] {
    patricia::Arena<Slabs> arena;
    WallStore with(arena, 0.05), without(arena, 0.05);
    ColumnLedger ledger;
    for (int i = *rc::gen::inRange(1, 4); i > 0; --i) {
      const Columns columns = any_columns();
      const types::Se2 pose = any_pose();
      ledger.draw(with, columns, pose);
      ledger.move(with, columns, pose, pose);
      draw_columns(without, columns, pose);
    }
    RC_ASSERT(contents(with) == contents(without));
  }));
}

TEST(ColumnLedger, MovingThereAndBackRestoresTheStore) {
  EXPECT_TRUE(rc::check([] {
    patricia::Arena<Slabs> arena;
    WallStore store(arena, 0.05);
    ColumnLedger ledger;
    const Columns others = any_columns(), columns = any_columns();
    const types::Se2 of_others = any_pose(), here = any_pose(), there = any_pose();
    ledger.draw(store, others, of_others);
    ledger.draw(store, columns, here);
    const auto before = contents(store);
    ledger.move(store, columns, here, there);
    ledger.move(store, columns, there, here);
    RC_ASSERT(contents(store) == before);
  }));
}

}  // namespace
}  // namespace topo::walls
