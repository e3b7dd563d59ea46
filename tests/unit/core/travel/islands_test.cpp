// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/travel/islands.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "tests/unit/core/travel/drawn_map.hpp"

namespace topo::travel {
namespace {

/// 0.3 m, with cells of 0.1 m.
constexpr double kSide_m = 0.3;
std::vector<std::string> opened(const std::vector<std::string>& rows) {
  return text_of(without_islands(drawn_map(rows, 0.1), kSide_m));
}

TEST(Islands, WhatStandsFreeAndIsSmallIsFree) {
  EXPECT_EQ(opened({"...........",  //
                    ".###...#...",  //
                    ".###....#..",  //
                    ".###.....#.",  //
                    "..........."}),
            std::vector<std::string>(5, "..........."));
}

TEST(Islands, WhatIsLongerThanASideStays) {
  const std::vector<std::string> rows{"...........",  //
                                      ".####..#...",  //
                                      ".......#...",  //
                                      ".......#...",  //
                                      ".......#..."};
  EXPECT_EQ(opened(rows), rows);
}

TEST(Islands, WhatTouchesAWallIsOneWithIt) {
  const std::vector<std::string> rows{"###########",  //
                                      "...........",  //
                                      "##.........",  //
                                      "..#########",  //
                                      "..........."};
  EXPECT_EQ(opened(rows), rows) << "over a corner, too";
}

TEST(Islands, WhatIsUnknownWithinASideOfThemIsTheirInside) {
  EXPECT_EQ(opened({".........",  //
                    ".##      ",  //
                    ".........",  //
                    "........."}),
            (std::vector<std::string>{".........",  //
                                      "......   ",  //
                                      ".........",  //
                                      "........."}));
  const std::vector<std::string> wall{".......", "#######", "       ", "......."};
  EXPECT_EQ(opened(wall), wall);
}

/// No cell is closed, walls stay, and what is left has no island.
TEST(Islands, AreGoneAtOnce) {
  EXPECT_TRUE(rc::check([] {
    grid::DenseMap map = drawn_map(std::vector<std::string>(20, std::string(30, '.')), 0.1);
    for (grid::CellState& cell : map.cells) {
      const int what = *rc::gen::inRange(0, 10);
      if (what < 3) cell = what == 0 ? grid::CellState::kUnknown : grid::CellState::kOccupied;
    }
    const grid::DenseMap open = without_islands(map, kSide_m);
    for (std::size_t i = 0; i < map.cells.size(); ++i)
      RC_ASSERT(open.cells[i] == map.cells[i] || open.cells[i] == grid::CellState::kFree);
    RC_ASSERT(without_islands(open, kSide_m).cells == open.cells);
  }));
}

}  // namespace
}  // namespace topo::travel
