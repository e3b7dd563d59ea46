// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/travel/narrow_passages.hpp"

#include <gtest/gtest.h>

#include "core/grid/distance.hpp"
#include "tests/unit/core/travel/drawn_map.hpp"

namespace topo::travel {
namespace {

constexpr double kCell_m = 0.1;

/// Two rooms of 2 m, with a wall of a metre's depth between and a door in it; beyond is a third that nothing
/// leads to. Each row is a cell high.
grid::DenseMap rooms(int door_from, int door_to) {
  std::vector<std::string> rows(22, std::string(73, '#'));
  for (std::size_t y = 1; y < 21; ++y) {
    rows[y].replace(1, 20, 20, '.');
    rows[y].replace(31, 20, 20, '.');
    rows[y].replace(52, 20, 20, '.');
  }
  for (int y = door_from; y < door_to; ++y) rows[static_cast<std::size_t>(y)].replace(21, 10, 10, '.');
  return drawn_map(rows, kCell_m);
}

struct Found {
  explicit Found(const grid::DenseMap& map) {
    const auto clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
    const grid::TravelField field = grid::travel_field(map, clearance_m, {5, 10}, {});
    ends = {static_cast<std::uint32_t>(map.index({40, 10})), static_cast<std::uint32_t>(map.index({42, 12})),
            static_cast<std::uint32_t>(map.index({60, 10})), static_cast<std::uint32_t>(map.index({6, 10}))};
    passages = narrow_passages(map, clearance_m, field, ends);
  }
  std::vector<std::uint32_t> ends;
  std::vector<NarrowPassage> passages;
};

TEST(NarrowPassages, ADoorTooNarrowIsNamedOnceWithItsWidth) {
  const Found found(rooms(8, 12));
  ASSERT_EQ(found.passages.size(), 1U) << "both ends beyond the door are shut off by it; the third by walls";
  const NarrowPassage& door = found.passages.front();
  EXPECT_NEAR(door.width_m, 0.4, 0.11);
  EXPECT_GT(door.p_map.x(), 2.0);
  EXPECT_LT(door.p_map.x(), 3.2);
  EXPECT_NEAR(door.p_map.y(), 1.2, 0.31);
}

TEST(NarrowPassages, ADoorWideEnoughIsNone) { EXPECT_TRUE(Found(rooms(5, 14)).passages.empty()); }

TEST(NarrowPassages, OfTwoDoorsTheWiderIsNamed) {
  grid::DenseMap map = rooms(8, 12);
  for (int x = 21; x < 31; ++x) {
    for (int y = 2; y < 4; ++y) map.cells[map.index({x, y})] = grid::CellState::kFree;
  }
  const Found found(map);
  ASSERT_EQ(found.passages.size(), 1U);
  EXPECT_NEAR(found.passages.front().width_m, 0.4, 0.11);
}

}  // namespace
}  // namespace topo::travel
