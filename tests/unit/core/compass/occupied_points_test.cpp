// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/compass/occupied_points.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
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

/// Any, of six rows and columns, or as many less.
grid::DenseMap any_map(int less) {
  grid::DenseMap map;
  map.box = {{-3, -3}, {2 - less, 2 - less}};
  for (int k = 0; k < map.width() * map.height(); ++k)
    map.cells.push_back(*rc::gen::element(grid::CellState::kOccupied, grid::CellState::kOccupied,
                                          grid::CellState::kFree, grid::CellState::kUnknown));
  return map;
}

TEST(OccupiedPoints, AreThoseOfTheWholeMapAndTellTheDifference) {
  EXPECT_TRUE(rc::check([] {
    OccupiedPoints occupied;
    grid::DenseMap map;
    std::vector<types::Vector2> before;
    for (int step = 0; step < 8; ++step) {
      grid::Rows others{0, 0};
      if (step == 0 || *rc::gen::inRange(0, 5) == 0) {
        map = *rc::gen::inRange(0, 5) == 0 ? grid::DenseMap{} : any_map(*rc::gen::inRange(0, 2));
        others.end = static_cast<std::size_t>(map.height());
      } else if (map.height() > 0) {
        const int first = *rc::gen::inRange(0, map.height()),
                  end = *rc::gen::inRange(first, map.height() + 1);
        others = {static_cast<std::size_t>(first), static_cast<std::size_t>(end)};
        for (int i = first * map.width(); i < end * map.width(); ++i)
          map.cells[static_cast<std::size_t>(i)] =
              *rc::gen::element(grid::CellState::kOccupied, grid::CellState::kFree);
      }
      const PointsChange now = occupied.take(map, others);
      const std::vector<types::Vector2> expected = occupied_points(map);
      RC_ASSERT(std::ranges::equal(now.now, expected));
      const PointsChange change = points_change(before, expected);
      RC_ASSERT(now.come == change.come);
      RC_ASSERT(now.gone == change.gone);
      before = expected;
    }
  }));
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
    EXPECT_TRUE(std::ranges::is_sorted(expected, comes_before)) << "row by row";
  }
}

}  // namespace
}  // namespace topo::compass
