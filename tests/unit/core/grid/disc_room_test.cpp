// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/grid/disc_room.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tests/unit/core/grid/maps.hpp"

namespace topo::grid {
namespace {

bool fits(const DenseMap& map, CellIndex middle, double radius_m) {
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const CellIndex c = map.cell(i);
    if (map.cells[i] == CellState::kOccupied &&
        std::hypot(c.x - middle.x, c.y - middle.y) * map.resolution_m < radius_m)
      return false;
  }
  return true;
}

RC_GTEST_PROP(DiscRoom, IsOpenWhereNoOccupiedCellIsInTheDisc, ()) {
  const DenseMap map = random_map(24);
  const double radius_m = *rc::gen::inRange(0, 17) * 0.025 + 0.001;
  const int x = *rc::gen::inRange(-6, 26), y = *rc::gen::inRange(-6, 26);
  const CellBox box{{x, y}, {x + *rc::gen::inRange(0, 20), y + *rc::gen::inRange(0, 20)}};
  const DiscRoom room(map, box, radius_m);
  for (int v = box.min.y - 1; v <= box.max.y + 1; ++v) {
    for (int u = box.min.x - 1; u <= box.max.x + 1; ++u) {
      const bool inside = u >= box.min.x && u <= box.max.x && v >= box.min.y && v <= box.max.y;
      RC_ASSERT(room.is_open({u, v}) == (inside && fits(map, {u, v}, radius_m)));
    }
  }
}

TEST(DiscRoom, WhatWasClosedStaysClosed) {
  DiscRoom room(filled_map(3, 3, CellState::kFree), {{0, 0}, {2, 2}}, 0.1);
  room.close({1, 1});
  EXPECT_FALSE(room.is_open({1, 1}));
  EXPECT_TRUE(room.is_open({1, 2}));
}

}  // namespace
}  // namespace topo::grid
