// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/compass/turned_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/types/se2.hpp"

namespace topo::bench {
namespace {

using grid::CellState;

/// 40 x 20 cells of 0.1 m, not at the origin: free, and a bar of 4 x 2 occupied cells in a corner of it.
grid::DenseMap room() {
  grid::DenseMap map{{{-7, 3}, {34, 24}}, 0.1, {}};
  map.cells.assign(static_cast<std::size_t>(map.width() * map.height()), CellState::kUnknown);
  for (int y = 4; y <= 23; ++y)
    for (int x = -6; x <= 33; ++x) map.cells[map.index({x, y})] = CellState::kFree;
  for (int y = 5; y <= 6; ++y)
    for (int x = 28; x <= 31; ++x) map.cells[map.index({x, y})] = CellState::kOccupied;
  return map;
}

std::vector<types::Vector2> occupied(const grid::DenseMap& map) {
  std::vector<types::Vector2> points;
  for (std::size_t i = 0; i < map.cells.size(); ++i)
    if (map.cells[i] == CellState::kOccupied) points.push_back(map.centre_of(map.cell(i)));
  return points;
}

TEST(TurnedMap, AQuarterMovesEveryCellToWhereItBelongs) {
  const grid::DenseMap map = room(), turned = turned_map(map, 0.5 * M_PI);
  const types::Vector2 middle(1.4, 1.4);  // of the array
  ASSERT_EQ(occupied(turned).size(), 8U);
  for (const types::Vector2& p : occupied(map)) {
    const types::Vector2 from = p - middle, to = middle + types::Vector2(-from.y(), from.x());
    EXPECT_EQ(turned.state(turned.cell_at(to)), CellState::kOccupied) << p.transpose();
  }
}

TEST(TurnedMap, KeepsTheAreaAndAnUnknownBorder) {
  const grid::DenseMap map = room();
  const auto free_cells = [](const grid::DenseMap& of) {
    return static_cast<double>(std::count(of.cells.begin(), of.cells.end(), CellState::kFree));
  };
  for (const double turn_deg : {0.0, 7.0, 45.0, 89.0, -30.0, 200.0}) {
    const grid::DenseMap turned = turned_map(map, turn_deg * types::kDegree_rad);
    EXPECT_NEAR(free_cells(turned) / free_cells(map), 1.0, 0.05) << turn_deg;
    for (std::size_t i = 0; i < turned.cells.size(); ++i) {
      if (turned.is_on_border(turned.cell(i))) {
        ASSERT_EQ(turned.cells[i], CellState::kUnknown) << turn_deg;
      }
    }
  }
}

TEST(TurnedMap, NothingStaysNothing) { EXPECT_TRUE(turned_map({}, 1.0).cells.empty()); }

TEST(SideBySide, HasTheCellsOfBothAndNothingElse) {
  const grid::DenseMap left = room(), right = turned_map(left, 0.5);
  const grid::DenseMap both = side_by_side(left, right);
  for (const CellState state : {CellState::kFree, CellState::kOccupied}) {
    EXPECT_EQ(std::count(both.cells.begin(), both.cells.end(), state),
              std::count(left.cells.begin(), left.cells.end(), state) +
                  std::count(right.cells.begin(), right.cells.end(), state));
  }
  EXPECT_EQ(both.state({28 + 7, 5 - 3}), CellState::kOccupied) << "the left one's bar";
  EXPECT_EQ(both.height(), std::max(left.height(), right.height()));
}

}  // namespace
}  // namespace topo::bench
