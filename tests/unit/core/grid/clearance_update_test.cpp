// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/grid/clearance_update.hpp"

#include <gtest/gtest.h>

#include "core/grid/distance.hpp"
#include "tests/unit/core/grid/maps.hpp"

namespace topo::grid {
namespace {

/// The cells within another box: unknown where there were none.
DenseMap moved_to(const DenseMap& map, const CellBox& box) {
  DenseMap out;
  out.box = box;
  out.resolution_m = map.resolution_m;
  out.cells.resize(static_cast<std::size_t>(out.width()) * static_cast<std::size_t>(out.height()));
  for (std::size_t i = 0; i < out.cells.size(); ++i) out.cells[i] = map.state(out.cell(i));
  return out;
}

TEST(ClearanceUpdate, IsTheWholeTransformWhateverTheMapBefore) {
  EXPECT_TRUE(rc::check("growing, shrinking and changing maps", [] {
    DenseMap map = random_map(48);
    ClearanceUpdate update;
    for (int step = 0; step < 8; ++step) {
      update.take(map);
      ASSERT_EQ(update.clearance_m(), clearance_m(map, Boundary::kOccupiedOrUnknown)) << "step " << step;
      CellBox box = map.box;
      box.min = {box.min.x - *rc::gen::inRange(-2, 4), box.min.y - *rc::gen::inRange(-2, 4)};
      box.max = {box.max.x + *rc::gen::inRange(-2, 4), box.max.y + *rc::gen::inRange(-2, 4)};
      if (!box.empty()) map = moved_to(map, box);
      for (int change = *rc::gen::inRange(0, 6); change > 0; --change) {
        const auto i = *rc::gen::inRange<std::size_t>(0, map.cells.size());
        map.cells[i] = *rc::gen::element(CellState::kFree, CellState::kOccupied, CellState::kUnknown);
      }
    }
  }));
}

TEST(ClearanceUpdate, OfPatchesHereAndThereIsThatOfTheWholeMap) {
  EXPECT_TRUE(rc::check([] {
    DenseMap map = filled_map(100, 130, CellState::kFree);
    ClearanceUpdate update;
    for (int step = 0; step < 12; ++step) {
      update.take(map);
      RC_ASSERT(update.clearance_m() == clearance_m(map, Boundary::kOccupiedOrUnknown));
      const int x = *rc::gen::inRange(0, 90), y = *rc::gen::inRange(0, 100), width = *rc::gen::inRange(1, 80),
                height = *rc::gen::inRange(1, 30);
      const auto state = *rc::gen::element(CellState::kFree, CellState::kOccupied, CellState::kUnknown);
      for (int j = y; j < y + height; ++j)
        for (int i = x; i < std::min(x + width, 100); ++i) map.cells[map.index({i, j})] = state;
    }
  }));
}

TEST(ClearanceUpdate, OfAHallIsThatOfTheWholeMap) {
  ClearanceUpdate update;
  DenseMap map = filled_map(400, 330, CellState::kFree);
  for (const CellIndex cell : {CellIndex{200, 165}, {200, 20}, {31, 165}, {200, 165}, {390, 300}}) {
    update.take(map);
    EXPECT_EQ(update.clearance_m(), clearance_m(map, Boundary::kOccupiedOrUnknown));
    CellState& state = map.cells[map.index(cell)];
    state = state == CellState::kFree ? CellState::kOccupied : CellState::kFree;
  }
}

TEST(ClearanceUpdate, AnotherMapIsAnotherMap) {
  ClearanceUpdate update;
  DenseMap map = filled_map(20, 10, CellState::kFree);
  update.take(map);
  map.resolution_m = 0.1;
  update.take(map);
  EXPECT_EQ(update.clearance_m(), clearance_m(map, Boundary::kOccupiedOrUnknown));
  update.take(DenseMap{});
  EXPECT_TRUE(update.clearance_m().empty());
  update.take(map);
  EXPECT_EQ(update.clearance_m(), clearance_m(map, Boundary::kOccupiedOrUnknown));
}

}  // namespace
}  // namespace topo::grid
