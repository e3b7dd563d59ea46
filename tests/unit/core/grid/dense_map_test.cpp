// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/grid/dense_map.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "core/grid/occupancy_grid.hpp"

#include <cmath>

namespace topo::grid {
namespace {

struct Grid {
  patricia::Arena<TileRef> arena;
  OccupancyGrid grid{arena, 0.05};

  void set(CellIndex c, CellCounts counts) {
    const int tx = c.x >> 5, ty = c.y >> 5;
    grid.tile_to_change(tx, ty).cells[Tile::index(c.x - tx * Tile::kSide, c.y - ty * Tile::kSide)] = counts;
  }
};

TEST(DenseMap, OfAnEmptyGridIsEmpty) {
  Grid g;
  EXPECT_TRUE(dense_map(g.grid).cells.empty());
  EXPECT_TRUE(dense_map(g.grid).box.empty());
  (void)g.grid.tile_to_change(3, -4);  // a tile in which nothing was seen
  EXPECT_TRUE(dense_map(g.grid).cells.empty());
}

TEST(DenseMap, OfOneCellIsTheCellAndItsMargin) {
  Grid g;
  g.set({-33, 64}, {1, 0});
  const DenseMap map = dense_map(g.grid);
  EXPECT_EQ(map.box.min, (CellIndex{-34, 63}));
  EXPECT_EQ(map.box.max, (CellIndex{-32, 65}));
  ASSERT_EQ(map.cells.size(), 9U);
  EXPECT_EQ(map.state({-33, 64}), CellState::kOccupied);
  EXPECT_EQ(dense_map(g.grid, 5).cells.size(), 121U);
  EXPECT_EQ(dense_map(g.grid, 0).cells.size(), 9U) << "the margin is at least one";
}

TEST(DenseMap, HasTheGridsStatesAndTheSmallestBox) {
  EXPECT_TRUE(rc::check("same states", [] {
    Grid g;
    const auto cells = *rc::gen::container<std::vector<std::pair<int, int>>>(
        rc::gen::pair(rc::gen::inRange(-100, 100), rc::gen::inRange(-100, 100)));
    for (const auto& [x, y] : cells) {
      g.set({x, y}, {*rc::gen::inRange<std::uint16_t>(0, 4), *rc::gen::inRange<std::uint16_t>(0, 12)});
    }
    const DenseMap map = dense_map(g.grid);
    const CellBox known = g.grid.known_box();
    RC_ASSERT(map.box.empty() == known.empty());
    if (known.empty()) return;
    RC_ASSERT(map.box.min == (CellIndex{known.min.x - 1, known.min.y - 1}));
    RC_ASSERT(map.box.max == (CellIndex{known.max.x + 1, known.max.y + 1}));
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      RC_ASSERT(map.cells[i] == g.grid.state(map.cell(i)));
      RC_ASSERT(map.index(map.cell(i)) == i);
    }
  }));
}

TEST(DenseMap, CountsUpToTheirLimitsGiveTheStateOfTheCell) {
  Grid g;
  const std::uint16_t values[] = {0, 1, 2, 3, 4, 21844, 21845, 21846, 65534, 65535};
  int x = 0;
  for (const std::uint16_t hits : values)
    for (const std::uint16_t misses : values) g.set({x++, 0}, {hits, misses});
  const DenseMap map = dense_map(g.grid);
  for (int i = 0; i < x; ++i) EXPECT_EQ(map.state({i, 0}), g.grid.state({i, 0})) << i;
}

TEST(DenseMap, CellsBeginBelowTheirPoints) {
  for (const double value : {-3.0, -2.5, -1e-9, -0.0, 0.0, 0.5, 1.0, 7.999999, 2147483646.5, -2147483648.0})
    EXPECT_EQ(floor_of(value), static_cast<std::int32_t>(std::floor(value))) << value;
}

TEST(DenseMap, CellsPlacesAndIndicesBelongTogether) {
  EXPECT_TRUE(rc::check([] {
    const auto any = [](int low, int high) { return *rc::gen::inRange(low, high); };
    DenseMap map;
    map.resolution_m = *rc::gen::element(0.05, 0.1, 0.37);
    map.box.min = {any(-1000, 1000), any(-1000, 1000)};
    map.box.max = {map.box.min.x + any(0, 20), map.box.min.y + any(0, 20)};
    map.cells.assign(static_cast<std::size_t>(map.width() * map.height()), CellState::kFree);
    std::size_t i = 0;
    for (int y = map.box.min.y - 1; y <= map.box.max.y + 1; ++y) {
      for (int x = map.box.min.x - 1; x <= map.box.max.x + 1; ++x) {
        const CellIndex c{x, y};
        RC_ASSERT(map.cell_at(map.centre_of(c)) == c);
        const bool beyond_x = x < map.box.min.x || x > map.box.max.x,
                   beyond_y = y < map.box.min.y || y > map.box.max.y;
        RC_ASSERT(map.contains(c) == !(beyond_x || beyond_y));
        RC_ASSERT(map.state(c) == (map.contains(c) ? CellState::kFree : CellState::kUnknown));
        if (!map.contains(c)) continue;
        RC_ASSERT(map.index(c) == i++);
        bool at_edge = false;
        for (const CellIndex beside : {CellIndex{x + 1, y}, {x - 1, y}, {x, y + 1}, {x, y - 1}})
          at_edge = at_edge || !map.contains(beside);
        RC_ASSERT(map.is_on_border(c) == at_edge);
      }
    }
    RC_ASSERT(i == map.cells.size());
  }));
}

}  // namespace
}  // namespace topo::grid
