// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/compass/occupied_points.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace topo::compass {
namespace {

TEST(OccupiedPoints, AreTheSurfaceOfWhatIsOccupied) {
  grid::DenseMap map;
  EXPECT_TRUE(occupied_points(map).empty());
  map.box = {{-3, -3}, {3, 3}};
  map.cells.assign(49, grid::CellState::kUnknown);
  EXPECT_TRUE(occupied_points(map).empty());
  for (int y = -2; y <= 2; ++y)
    for (int x = -2; x <= 2; ++x) map.cells[map.index({x, y})] = grid::CellState::kOccupied;
  const auto points = occupied_points(map);
  EXPECT_EQ(points.size(), 16U);
  EXPECT_NEAR((points[0] - types::Vector2(-0.075, -0.075)).norm(), 0.0, 1e-9);
}

TEST(OccupiedPoints, AreTheCellsWithANeighbourThatIsNotOccupied) {
  using grid::CellState;
  for (unsigned seed = 0; seed < 50; ++seed) {
    std::mt19937 random(seed);
    grid::DenseMap map;
    map.resolution_m = 0.1;
    map.box.min = {-static_cast<int>(random() % 9), -static_cast<int>(random() % 9)};
    map.box.max = {map.box.min.x + static_cast<int>(random() % 15),
                   map.box.min.y + static_cast<int>(random() % 15)};
    for (int k = 0; k < map.width() * map.height(); ++k) {
      const auto kind = random() % 10;
      map.cells.push_back(kind < 7   ? CellState::kOccupied
                          : kind < 9 ? CellState::kFree
                                     : CellState::kUnknown);
    }
    std::vector<types::Vector2> expected;
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      const grid::CellIndex c = map.cell(i);
      const auto is_occupied = [&](int dx, int dy) {
        return map.state({c.x + dx, c.y + dy}) == CellState::kOccupied;
      };
      const bool is_inside =
          is_occupied(1, 0) && is_occupied(-1, 0) && is_occupied(0, 1) && is_occupied(0, -1);
      if (is_occupied(0, 0) && !is_inside) expected.push_back(map.centre_of(c));
    }
    EXPECT_EQ(occupied_points(map), expected) << seed;
  }
}

}  // namespace
}  // namespace topo::compass
