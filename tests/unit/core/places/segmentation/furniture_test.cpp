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

/// The same, cell by cell: islands are flooded from each of their cells.
DenseMap without_islands(const DenseMap& map, int side) {
  DenseMap open = map;
  std::vector<std::uint8_t> seen(map.cells.size(), 0);
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    if (map.cells[i] == CellState::kFree || seen[i] != 0) continue;
    std::vector<std::size_t> island{i};
    seen[i] = 1;
    grid::CellBox box{map.cell(i), map.cell(i)};
    for (std::size_t k = 0; k < island.size(); ++k) {
      const grid::CellIndex c = map.cell(island[k]);
      box = {{std::min(box.min.x, c.x), std::min(box.min.y, c.y)},
             {std::max(box.max.x, c.x), std::max(box.max.y, c.y)}};
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const grid::CellIndex n{c.x + dx, c.y + dy};
          if (!map.contains(n) || map.state(n) == CellState::kFree || seen[map.index(n)] != 0) continue;
          seen[map.index(n)] = 1;
          island.push_back(map.index(n));
        }
      }
    }
    const bool inside = !map.is_on_border(box.min) && !map.is_on_border(box.max);
    if (!inside || box.width() > side || box.height() > side) continue;
    for (const std::size_t k : island) open.cells[k] = CellState::kFree;
  }
  return open;
}

TEST(Furniture, AreTheSmallIslandsOfCellsThatAreNotFree) {
  EXPECT_TRUE(rc::check([] {
    DenseMap map = DrawnMap(*rc::gen::inRange(3, 90), *rc::gen::inRange(3, 60)).map();
    draw_patches(map, *rc::gen::inRange(0, 40), *rc::gen::element(3, 12, 30));
    const int side = *rc::gen::inRange(1, 20);
    RC_ASSERT(without_furniture(map, {}, side * map.resolution_m).cells == without_islands(map, side).cells);
  }));
}

TEST(Furniture, OnlyAlongWallsStaysAsItWas) {
  EXPECT_TRUE(rc::check([] {
    DenseMap map = DrawnMap(120, 80).room(4, 4, 116, 76).map();
    draw_patches(map, *rc::gen::inRange(0, 40), 12);
    const std::vector<types::Segment> walls = some_walls();
    const DenseMap bare = without_furniture(map, {}, 1.0), open = without_furniture(map, walls, 1.0);
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      if (open.cells[i] == bare.cells[i]) continue;
      RC_ASSERT(open.cells[i] == map.cells[i]);
      const types::Vector2 p = map.centre_of(map.cell(i));
      const bool is_near = std::ranges::any_of(walls, [&](const types::Segment& wall) {
        const types::Vector2 along = wall.b - wall.a;
        const double at = std::clamp((p - wall.a).dot(along) / along.squaredNorm(), 0.0, 1.0);
        return (p - wall.a - at * along).norm() <= 2.2 * map.resolution_m;
      });
      RC_ASSERT(is_near);
    }
  }));
}

}  // namespace
}  // namespace topo::places
