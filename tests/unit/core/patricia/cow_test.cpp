// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/patricia/cow.hpp"

#include <gtest/gtest.h>

#include <array>

#include "core/patricia/map.hpp"

namespace topo::patricia {
namespace {

struct Tile {
  std::array<float, 1024> cells{};
};

TEST(Cow, EmptyReadsAsValueInitialised) {
  const Cow<Tile> tile;
  EXPECT_EQ(tile.read().cells[5], 0.0F);
  EXPECT_FALSE(tile.shared());
}

TEST(Cow, ClonesOnlyWhatIsShared) {
  Cow<Tile> a;
  a.write().cells[5] = 1.0F;
  const Tile* alone = &a.read();
  a.write().cells[6] = 2.0F;
  EXPECT_EQ(&a.read(), alone);

  Cow<Tile> b = a;
  EXPECT_TRUE(a.shared());
  EXPECT_EQ(a, b);
  b.write().cells[5] = 3.0F;
  EXPECT_FALSE(a.shared());
  EXPECT_NE(a, b);
  EXPECT_EQ(a.read().cells[5], 1.0F);
  EXPECT_EQ(b.read().cells[5], 3.0F);
  EXPECT_EQ(b.read().cells[6], 2.0F);
  EXPECT_EQ(&a.read(), alone);
}

TEST(Cow, MovesAndAssigns) {
  Cow<Tile> a(Tile{});
  a.write().cells[0] = 4.0F;
  Cow<Tile> b(std::move(a));
  EXPECT_EQ(b.read().cells[0], 4.0F);
  Cow<Tile> c;
  c = b;
  EXPECT_TRUE(b.shared());
  c = Cow<Tile>();
  EXPECT_FALSE(b.shared());
  Cow<Tile>& self = b;
  b = self;
  EXPECT_EQ(b.read().cells[0], 4.0F);
}

TEST(CowInMap, AWrittenTileIsClonedOnceASnapshotAndOthersStayShared) {
  Arena<Cow<Tile>> arena;
  Map<Cow<Tile>> tiles(arena);
  for (std::int32_t i = 0; i < 16; ++i) tiles.update(cell_key(i, 0)).write().cells[0] = 1.0F;
  const Map<Cow<Tile>> snapshot = tiles;

  tiles.update(cell_key(3, 0)).write().cells[0] = 2.0F;
  const Tile* clone = &tiles.find(cell_key(3, 0))->read();
  tiles.update(cell_key(3, 0)).write().cells[1] = 5.0F;
  EXPECT_EQ(&tiles.find(cell_key(3, 0))->read(), clone);
  EXPECT_EQ(snapshot.find(cell_key(3, 0))->read().cells[0], 1.0F);
  EXPECT_EQ(&snapshot.find(cell_key(4, 0))->read(), &tiles.find(cell_key(4, 0))->read());

  std::size_t changed = 0;
  Map<Cow<Tile>>::difference(snapshot, tiles, [&](Key key, const auto* before, const auto* after) {
    ++changed;
    EXPECT_EQ(cell_of(key).x, 3);
    ASSERT_TRUE(before != nullptr && after != nullptr);
    EXPECT_EQ(after->read().cells[1], 5.0F);
  });
  EXPECT_EQ(changed, 1U);
}

}  // namespace
}  // namespace topo::patricia
