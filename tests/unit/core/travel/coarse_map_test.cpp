// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/travel/coarse_map.hpp"

#include <gtest/gtest.h>

#include "core/grid/distance.hpp"
#include "tests/unit/core/grid/maps.hpp"

namespace topo::travel {
namespace {

using grid::CellState;

TEST(CoarseMap, aCoarserMapHidesNoObstacleAndNarrowsNoWay) {
  EXPECT_TRUE(rc::check([] {
    CoarseMap fine;
    fine.map = grid::random_map(40);
    fine.clearance_m = grid::clearance_m(fine.map, grid::Boundary::kOccupiedOrUnknown);
    const CoarseMap coarse = coarser(fine.map, fine.clearance_m);
    RC_ASSERT(coarse.map.resolution_m == 2.0 * fine.map.resolution_m);
    for (std::size_t i = 0; i < fine.map.cells.size(); ++i) {
      const types::Vector2 centre = fine.map.centre_of(fine.map.cell(i));
      const grid::CellIndex there = coarse.map.cell_at(centre);
      const CellState state = coarse.map.state(there);
      RC_ASSERT(state >= fine.map.cells[i]);  // unknown, free, occupied
      RC_ASSERT(state != CellState::kFree ||
                coarse.clearance_m[coarse.map.index(there)] >= fine.clearance_m[i]);
    }
    // ... and invents none.
    for (std::size_t i = 0; i < coarse.map.cells.size(); ++i) {
      const grid::CellIndex at = coarse.map.cell(i);
      bool found = coarse.map.cells[i] == CellState::kUnknown;
      for (int k = 0; k < 4; ++k)
        found = found || fine.map.state({2 * at.x + k % 2, 2 * at.y + k / 2}) == coarse.map.cells[i];
      RC_ASSERT(found);
    }
  }));
}

TEST(CoarseMap, aCoarserMapHasUnknownCellsAllAround) {
  CoarseMap fine;
  fine.map = grid::filled_map(7, 5, CellState::kFree);
  fine.clearance_m.assign(fine.map.cells.size(), 1.0F);
  const CoarseMap coarse = coarser(fine.map, fine.clearance_m);
  for (std::size_t i = 0; i < coarse.map.cells.size(); ++i) {
    const grid::CellIndex at = coarse.map.cell(i);
    const bool outermost = at.x == coarse.map.box.min.x || at.x == coarse.map.box.max.x ||
                           at.y == coarse.map.box.min.y || at.y == coarse.map.box.max.y;
    EXPECT_TRUE(!outermost || coarse.map.cells[i] == CellState::kUnknown);
  }
  EXPECT_TRUE(coarser({}, {}).map.cells.empty());
}

TEST(CoarseMap, TwoDoublingsAreOneAfterTheOther) {
  EXPECT_TRUE(rc::check([] {
    CoarseMap fine;
    fine.map = grid::random_map(40);
    const grid::CellIndex by{*rc::gen::inRange(-20, 20), *rc::gen::inRange(-20, 20)};
    fine.map.box = {{fine.map.box.min.x + by.x, fine.map.box.min.y + by.y},
                    {fine.map.box.max.x + by.x, fine.map.box.max.y + by.y}};
    fine.clearance_m = grid::clearance_m(fine.map, grid::Boundary::kOccupiedOrUnknown);
    const CoarseMap once = coarser(fine.map, fine.clearance_m), twice = coarser(once.map, once.clearance_m),
                    both = coarser(fine.map, fine.clearance_m, 2);
    RC_ASSERT(both.map.resolution_m == twice.map.resolution_m);
    for (std::size_t i = 0; i < both.map.cells.size(); ++i) {
      const grid::CellIndex c = both.map.cell(i);
      RC_ASSERT(both.map.cells[i] == twice.map.state(c));
      const bool is_inside = twice.map.contains(c);
      RC_ASSERT(both.clearance_m[i] == (is_inside ? twice.clearance_m[twice.map.index(c)] : 0.0F));
    }
    const CoarseMap none = coarser(fine.map, fine.clearance_m, 0);
    for (std::size_t i = 0; i < none.map.cells.size(); ++i)
      RC_ASSERT(none.map.cells[i] == fine.map.state(none.map.cell(i)));
  }));
}

}  // namespace
}  // namespace topo::travel
