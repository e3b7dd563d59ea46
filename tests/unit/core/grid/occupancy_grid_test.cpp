// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/grid/occupancy_grid.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <map>
#include <utility>

namespace topo::grid {
namespace {

TEST(StateOf, NeedsAQuarterOfTheEvidence) {
  EXPECT_EQ(state_of({0, 0}), CellState::kUnknown);
  EXPECT_EQ(state_of({0, 1}), CellState::kFree);
  EXPECT_EQ(state_of({1, 0}), CellState::kOccupied);
  EXPECT_EQ(state_of({1, 3}), CellState::kOccupied);
  EXPECT_EQ(state_of({1, 4}), CellState::kFree);
}

TEST(OccupancyGrid, CellsHaveTheirLowerCornerAtTheirIndex) {
  patricia::Arena<TileRef> arena;
  const OccupancyGrid grid(arena, 0.05);
  EXPECT_EQ(grid.cell_at({0.0, 0.0}), (CellIndex{0, 0}));
  EXPECT_EQ(grid.cell_at({-0.01, 0.049}), (CellIndex{-1, 0}));
  EXPECT_NEAR(grid.centre_of({-1, 2}).x(), -0.025, 1e-12);
  EXPECT_NEAR(grid.centre_of({-1, 2}).y(), 0.125, 1e-12);
}

TEST(OccupancyGrid, FindsCellsAcrossTileBordersOnBothSidesOfZero) {
  patricia::Arena<TileRef> arena;
  OccupancyGrid grid(arena, 0.05);
  grid.tile_to_change(-1, 0).cells[Tile::index(31, 5)].hits = 3;
  EXPECT_EQ(grid.counts({-1, 5}).hits, 3);
  EXPECT_EQ(grid.state({-2, 5}), CellState::kUnknown);
  EXPECT_EQ(grid.state({100, 100}), CellState::kUnknown);
  const CellBox box = grid.known_box();
  EXPECT_EQ(box.min, (CellIndex{-1, 5}));
  EXPECT_EQ(box.max, (CellIndex{-1, 5}));
}

TEST(OccupancyGrid, ACopyIsASnapshot) {
  patricia::Arena<TileRef> arena;
  OccupancyGrid grid(arena, 0.05);
  grid.tile_to_change(0, 0).cells[0].misses = 1;
  const OccupancyGrid before = grid;
  grid.tile_to_change(0, 0).cells[0].hits = 9;
  grid.tile_to_change(4, 4).cells[0].hits = 9;
  EXPECT_EQ(before.state({0, 0}), CellState::kFree);
  EXPECT_EQ(before.tiles().size(), 1U);
  EXPECT_EQ(grid.state({0, 0}), CellState::kOccupied);
}

TEST(OccupancyGrid, TwoVersionsDifferByTheCellsInAnotherState) {
  EXPECT_TRUE(rc::check([] {
    patricia::Arena<TileRef> arena;
    OccupancyGrid grid(arena, 0.05);
    const auto change = [&](int times) {
      for (int i = 0; i < times; ++i) {
        const auto at = [] { return *rc::gen::inRange(-40, 40); };
        const int x = at(), y = at();
        auto& counts = grid.tile_to_change(x >> 5, y >> 5).cells[Tile::index(x & 31, y & 31)];
        counts = {static_cast<std::uint16_t>(*rc::gen::inRange(0, 3)),
                  static_cast<std::uint16_t>(*rc::gen::inRange(0, 9))};
      }
    };
    change(*rc::gen::inRange(0, 30));
    const OccupancyGrid before = grid;
    change(*rc::gen::inRange(0, 30));
    std::size_t differing = 0;
    for (int y = -40; y < 40; ++y)
      for (int x = -40; x < 40; ++x) differing += before.state({x, y}) != grid.state({x, y}) ? 1U : 0U;
    RC_ASSERT(differing_cells(before, grid) == differing);
    RC_ASSERT(differing_cells(grid, before) == differing);
  }));
}

TEST(StateOf, MoreHitsNeverFreeACellAndMoreMissesNeverOccupyIt) {
  EXPECT_TRUE(rc::check([] {
    const auto any = [] { return *rc::gen::inRange<std::uint16_t>(0, 400); };
    const CellCounts counts{any(), any()};
    const auto more = [&](int hits, int misses) {
      return state_of({static_cast<std::uint16_t>(counts.hits + hits),
                       static_cast<std::uint16_t>(counts.misses + misses)});
    };
    if (state_of(counts) == CellState::kOccupied) RC_ASSERT(more(any(), 0) == CellState::kOccupied);
    if (state_of(counts) == CellState::kFree) RC_ASSERT(more(0, any()) == CellState::kFree);
    RC_ASSERT(more(1, 0) != CellState::kUnknown);
    RC_ASSERT(more(0, 1) != CellState::kUnknown);
    // As said: a quarter of the evidence.
    const double share = counts.hits / std::max(1.0, counts.hits + 1.0 * counts.misses);
    RC_ASSERT((state_of(counts) == CellState::kOccupied) == (counts.hits > 0 && share >= 0.25));
  }));
}

TEST(OccupancyGrid, EachKnownCellIsVisitedOnceWithItsState) {
  EXPECT_TRUE(rc::check([] {
    patricia::Arena<TileRef> arena;
    OccupancyGrid grid(arena, 0.05);
    std::map<std::pair<int, int>, CellCounts> expected;
    for (int cells = *rc::gen::inRange(0, 40); cells > 0; --cells) {
      const int x = *rc::gen::inRange(-90, 90), y = *rc::gen::inRange(-90, 90);
      const CellCounts counts{*rc::gen::inRange<std::uint16_t>(0, 3), *rc::gen::inRange<std::uint16_t>(1, 9)};
      grid.tile_to_change(x >> 5, y >> 5).cells[Tile::index(x & 31, y & 31)] = counts;
      expected[{x, y}] = counts;
    }
    CellBox box;
    std::size_t visited = 0;
    grid.for_each_known([&](CellIndex c, CellState state) {
      ++visited;
      box.extend(c);
      const auto at = expected.find({c.x, c.y});
      RC_ASSERT(at != expected.end());
      RC_ASSERT(state == state_of(at->second));
      RC_ASSERT(grid.counts(c) == at->second);
      RC_ASSERT(grid.cell_at(grid.centre_of(c)) == c);
    });
    RC_ASSERT(visited == expected.size());
    RC_ASSERT(grid.known_box() == box);
    grid.clear();
    RC_ASSERT(grid.known_box().empty());
    RC_ASSERT(grid.tiles().size() == 0U);
  }));
}

}  // namespace
}  // namespace topo::grid
