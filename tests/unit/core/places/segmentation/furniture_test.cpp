// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/furniture.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <vector>

#include "tests/unit/core/places/drawn_map.hpp"
#include "tests/unit/core/places/patches.hpp"

namespace topo::places {
namespace {

using grid::CellState;
using grid::DenseMap;

TEST(Furniture, GoesWhereItStandsFreeAndIsShort) {
  DrawnMap drawn = DrawnMap(200, 200).room(10, 10, 190, 190);
  const DenseMap empty = drawn.map();
  drawn.occupied(50, 50, 60, 58).occupied(60, 58, 65, 62).fill(100, 100, 110, 110, CellState::kUnknown);
  EXPECT_EQ(without_furniture(drawn.map(), {}, 1.0).cells, empty.cells) << "what touches over corners is one";
}

TEST(Furniture, StaysWhereItIsLongOrTouchesTheWallOrIsAWall) {
  DrawnMap drawn =
      DrawnMap(200, 200).room(10, 10, 190, 190).occupied(40, 40, 61, 45).occupied(10, 100, 18, 110);
  EXPECT_EQ(without_furniture(drawn.map(), {}, 1.0).cells, drawn.map().cells);
  drawn.occupied(100, 99, 118, 101);
  const std::vector<types::Segment> walls{{{4.9, 5.0}, {6.0, 5.0}}};
  EXPECT_EQ(without_furniture(drawn.map(), walls, 1.0).cells, drawn.map().cells);
  EXPECT_NE(without_furniture(drawn.map(), {}, 1.0).cells, drawn.map().cells);
}

TEST(Furniture, OfNothingIsNothing) { EXPECT_TRUE(without_furniture(DenseMap{}, {}, 1.0).cells.empty()); }

/// Walls along which furniture stays, some of them across it.
std::vector<types::Segment> some_walls() {
  std::vector<types::Segment> walls;
  for (int k = *rc::gen::inRange(0, 3); k > 0; --k) {
    const auto metres = [] { return 0.05 * *rc::gen::inRange(-10, 180); };
    walls.push_back({{metres(), metres()}, {metres(), metres()}});
  }
  return walls;
}

/// From the first to the last row that is another one.
grid::Rows other_rows(const DenseMap& a, const DenseMap& b) {
  grid::Rows rows;
  const auto width = static_cast<std::size_t>(a.width());
  for (std::size_t i = 0; i < a.cells.size(); ++i) {
    if (a.cells[i] == b.cells[i]) continue;
    if (rows.empty()) rows.first = i / width;
    rows.end = i / width + 1;
  }
  return rows;
}

/// A map with some blocks of cells of another one.
DenseMap with_blocks_of(const DenseMap& other, const grid::CellBlocks& blocks, DenseMap map) {
  blocks.for_each([&](std::size_t first, std::size_t end) {
    std::copy(&other.cells[first], other.cells.data() + end, &map.cells[first]);
  });
  return map;
}

TEST(Furniture, OfOneMapAfterTheOtherIsThatOfTheWholeMap) {
  EXPECT_TRUE(rc::check([] {
    DenseMap map = DrawnMap(170, 90).room(4, 4, 166, 86).map();
    draw_patches(map, 30, 12);
    FurnitureUpdate update;
    DenseMap before, open_before;
    double furniture_before_m = 0.0;
    for (int step = 0; step < 6; ++step) {
      const std::vector<types::Segment> walls = some_walls();
      const double furniture_m = *rc::gen::inRange(0, 8) == 0 ? 0.4 : 0.6;
      const grid::Rows others = update.take(map, furniture_m);
      if (step > 0 && furniture_m == furniture_before_m) RC_ASSERT(others == other_rows(before, map));
      const DenseMap& open = update.clear(map, walls);
      RC_ASSERT(open.cells == without_furniture(map, walls, furniture_m).cells);
      if (step > 0) RC_ASSERT(with_blocks_of(open, update.others(), open_before).cells == open.cells);
      open_before = open;
      before = map;
      furniture_before_m = furniture_m;
      draw_patches(map, *rc::gen::inRange(0, 3), *rc::gen::inRange(2, 20));
    }
  }));
}

TEST(Furniture, SaysThatLittleIsAnotherCellWhereLittleHasChanged) {
  DenseMap map = DrawnMap(170, 90).room(4, 4, 166, 86).occupied(40, 40, 48, 44).map();
  FurnitureUpdate update;
  update.take(map, 1.0);
  update.clear(map, {});
  map.cells[map.index({100, 60})] = CellState::kOccupied;
  update.take(map, 1.0);
  std::size_t cells = 0;
  update.others().for_each([&](std::size_t first, std::size_t end) { cells += end - first; });
  EXPECT_GT(cells, 0U);
  EXPECT_LT(cells, map.cells.size() / 20);
}

TEST(Furniture, OfAnotherMapIsThatOfTheOtherMap) {
  const DenseMap one = DrawnMap(80, 60).room(4, 4, 76, 56).occupied(20, 20, 28, 28).map(),
                 other = DrawnMap(90, 60).room(4, 4, 86, 56).occupied(40, 20, 48, 28).map();
  FurnitureUpdate update;
  for (const DenseMap& map : {one, other, DenseMap{}, one}) {
    EXPECT_EQ(update.take(map, 1.0), (grid::Rows{0, static_cast<std::size_t>(map.height())}));
    EXPECT_EQ(update.clear(map, {}).cells, without_furniture(map, {}, 1.0).cells);
  }
  DenseMap coarse = one;
  coarse.resolution_m = 0.1;
  EXPECT_EQ(update.take(coarse, 0.7), (grid::Rows{0, static_cast<std::size_t>(coarse.height())}));
  EXPECT_EQ(update.clear(coarse, {}).cells, without_furniture(coarse, {}, 0.7).cells);
}

}  // namespace
}  // namespace topo::places
