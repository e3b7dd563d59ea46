// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/cell_tiles.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "tests/unit/core/places/drawn_map.hpp"

namespace topo::places {
namespace {

TEST(CellTiles, AreFoundByWhateverLiesInABox) {
  EXPECT_TRUE(rc::check([] {
    const DrawnMap drawn(*rc::gen::inRange(1, 150), *rc::gen::inRange(1, 90));
    const grid::DenseMap& map = drawn.map();
    CellTiles tiles(map);
    const auto first = *rc::gen::inRange<std::uint32_t>(0, static_cast<std::uint32_t>(map.cells.size()));
    const auto end = std::min(first + *rc::gen::inRange<std::uint32_t>(1, 300),
                              static_cast<std::uint32_t>(map.cells.size()));
    tiles.add({first, end});
    grid::CellBox box;
    box.extend({*rc::gen::inRange(-20, 170), *rc::gen::inRange(-20, 110)});
    box.extend({*rc::gen::inRange(-20, 170), *rc::gen::inRange(-20, 110)});
    bool is_within = false;
    for (std::uint32_t i = first; i < end; ++i) {
      const grid::CellIndex c = map.cell(i);
      is_within |= c.x >= box.min.x && c.x <= box.max.x && c.y >= box.min.y && c.y <= box.max.y;
    }
    RC_ASSERT(tiles.may_have(box) || !is_within);
  }));
}

TEST(CellTiles, AreNotFoundFarAway) {
  const DrawnMap drawn(300, 300);
  CellTiles tiles(drawn.map());
  const auto i = static_cast<std::uint32_t>(drawn.map().index({100, 100}));
  tiles.add({i, i + 5});
  EXPECT_TRUE(tiles.may_have({{90, 90}, {101, 101}}));
  EXPECT_FALSE(tiles.may_have({{140, 0}, {299, 299}}));
  EXPECT_FALSE(tiles.may_have({{0, 140}, {299, 299}}));
  EXPECT_FALSE(tiles.may_have({{0, 0}, {60, 299}}));
}

}  // namespace
}  // namespace topo::places
