// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/goals/frontiers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "tests/unit/core/goals/scene.hpp"
#include "tests/unit/core/grid/maps.hpp"

namespace topo::goals {
namespace {

using grid::CellIndex;
using grid::CellState;
using grid::DenseMap;

/// A room of 4 m by 2 m with walls, of which the cells right of x = seen are unknown.
DenseMap half_seen_room(int seen) {
  DenseMap map = grid::filled_map(80, 40, CellState::kFree);
  for (int x = 0; x < 80; ++x) {
    for (int y = 0; y < 40; ++y) {
      CellState& cell = map.cells[map.index({x, y})];
      if (x == 0 || x == 79 || y == 0 || y == 39) cell = CellState::kOccupied;
      if (x > seen) cell = CellState::kUnknown;
    }
  }
  return map;
}

TEST(Frontiers, OfAHalfSeenRoomIsOneLine) {
  const DenseMap map = half_seen_room(40);
  const auto frontiers = find_frontiers(map);
  ASSERT_EQ(frontiers.size(), 1U);
  EXPECT_EQ(frontiers[0].cells.size(), 38U);
  EXPECT_NEAR(frontiers[0].width_m, 38 * 0.05, 1e-9);
  EXPECT_NEAR(frontiers[0].centroid.x(), 40.5 * 0.05, 1e-9);
  EXPECT_NEAR(frontiers[0].centroid.y(), 20.0 * 0.05, 1e-9);
}

TEST(Frontiers, OfAClosedRoomAreNone) { EXPECT_TRUE(find_frontiers(half_seen_room(80)).empty()); }

TEST(Frontiers, OfUniformMaps) {
  EXPECT_TRUE(find_frontiers(DenseMap{}).empty());
  EXPECT_TRUE(find_frontiers(grid::filled_map(40, 40, CellState::kOccupied), 0.0).empty());
  EXPECT_TRUE(find_frontiers(grid::filled_map(40, 40, CellState::kUnknown), 0.0).empty());
  const auto round = find_frontiers(grid::filled_map(40, 30, CellState::kFree));
  ASSERT_EQ(round.size(), 1U);
  EXPECT_EQ(round[0].cells.size(), 2U * 40U + 2U * 28U);
  EXPECT_EQ(find_frontiers(grid::filled_map(1, 1, CellState::kFree), 0.05).size(), 1U);
  EXPECT_EQ(find_frontiers(grid::filled_map(1, 1, CellState::kFree)).size(), 0U);
}

TEST(Frontiers, WithoutAMarginTheOutsideIsUnknown) {
  const auto frontiers = find_frontiers(grid::drawn_map({"...", "...", "..."}), 0.0);
  ASSERT_EQ(frontiers.size(), 1U);
  EXPECT_EQ(frontiers[0].cells.size(), 8U);
}

TEST(Frontiers, JoinAtCornersAndKeepTheOrderOfTheirFirstCells) {
  const auto frontiers =
      find_frontiers(grid::drawn_map({"########", "#?.#.?##", "#.##..##", "########"}), 0.0);
  ASSERT_EQ(frontiers.size(), 2U);
  EXPECT_EQ(frontiers[0].cells, (std::vector<std::uint32_t>{9, 18}));
  EXPECT_EQ(frontiers[1].cells, (std::vector<std::uint32_t>{13, 20}));
}

TEST(Frontiers, FifteenCellsAreThreeQuartersOfAMetre) {
  for (const int open : {14, 15}) {
    DenseMap map = grid::filled_map(10, 30, CellState::kOccupied);
    for (int y = 5; y < 5 + open; ++y) {
      map.cells[map.index({5, y})] = CellState::kFree;
      map.cells[map.index({6, y})] = CellState::kUnknown;
    }
    EXPECT_EQ(find_frontiers(map).size(), open == 15 ? 1U : 0U);
  }
}

/// Cells by a definition of one cell, without rows or clusters.
bool touches_unknown(const DenseMap& map, CellIndex c) {
  return map.state(c) == CellState::kFree && (map.state({c.x + 1, c.y}) == CellState::kUnknown ||
                                              map.state({c.x - 1, c.y}) == CellState::kUnknown ||
                                              map.state({c.x, c.y + 1}) == CellState::kUnknown ||
                                              map.state({c.x, c.y - 1}) == CellState::kUnknown);
}

TEST(Frontiers, AreAPartitionOfTheCellsThatTouchUnknownSpace) {
  EXPECT_TRUE(rc::check("partition", [] {
    const DenseMap map = grid::random_map(40);
    std::vector<int> owner(map.cells.size(), -1);
    const auto frontiers = find_frontiers(map, 0.0);
    for (std::size_t f = 0; f < frontiers.size(); ++f) {
      for (const std::uint32_t i : frontiers[f].cells) {
        RC_ASSERT(owner[i] == -1);
        owner[i] = static_cast<int>(f);
      }
    }
    for (std::size_t i = 0; i < owner.size(); ++i) {
      const CellIndex c = map.cell(i);
      RC_ASSERT((owner[i] >= 0) == touches_unknown(map, c));
      if (owner[i] < 0) continue;
      for (const CellIndex by : grid::kNeighbours) {
        const CellIndex n{c.x + by.x, c.y + by.y};
        if (map.contains(n)) RC_ASSERT(owner[map.index(n)] == -1 || owner[map.index(n)] == owner[i]);
      }
    }
  }));
}

DenseMap mirrored(const DenseMap& map) {
  DenseMap other = map;
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const CellIndex c = map.cell(i);
    other.cells[other.index({map.box.min.x + map.box.max.x - c.x, c.y})] = map.cells[i];
  }
  return other;
}

TEST(Frontiers, OfTheMirroredMapAreTheMirroredFrontiers) {
  EXPECT_TRUE(rc::check("mirrored", [] {
    const DenseMap map = grid::random_map(40);
    const double axis_m = (map.box.min.x + map.box.max.x + 1) * map.resolution_m;
    // In half cells, summed over the frontier, a centroid is a whole number: nothing to round up or down.
    const auto halves = [&](double p_m, const Frontier& f) {
      return std::lround(2.0 * p_m * static_cast<double>(f.cells.size()) / map.resolution_m);
    };
    const auto key = [&](double x, const Frontier& f) {
      return std::tuple(halves(x, f), halves(f.centroid.y(), f), std::lround(f.width_m / map.resolution_m),
                        f.cells.size());
    };
    std::vector<std::tuple<long, long, long, std::size_t>> here, there;
    for (const Frontier& f : find_frontiers(map)) here.push_back(key(f.centroid.x(), f));
    for (const Frontier& f : find_frontiers(mirrored(map))) there.push_back(key(axis_m - f.centroid.x(), f));
    std::sort(here.begin(), here.end());
    std::sort(there.begin(), there.end());
    RC_ASSERT(here == there);
  }));
}

TEST(ApproachCell, IsReachableInFrontOfTheMiddle) {
  const DenseMap map = half_seen_room(40);
  const auto frontiers = find_frontiers(map);
  const auto cell = approach_cell(map, frontiers.at(0), field_from(map, {10, 10}), 1.0);
  ASSERT_TRUE(cell);
  EXPECT_NEAR(cell->y, 20, 1);
  EXPECT_NEAR(cell->x, 35, 1) << "0.3 m of clearance from unknown space";
}

TEST(ApproachCell, IsNoneWhenNothingNearCanBeReached) {
  const DenseMap map = half_seen_room(40);
  const auto frontiers = find_frontiers(map);
  EXPECT_FALSE(approach_cell(map, frontiers.at(0), field_from(map, {10, 10}), 0.1));
  EXPECT_FALSE(approach_cell(map, frontiers.at(0), field_from(map, {500, 500}), 1.0));
  EXPECT_FALSE(approach_cell(map, Frontier{}, field_from(map, {10, 10}), 1.0));
}

TEST(ApproachCell, IsNotBehindAWall) {
  DenseMap map = half_seen_room(40);
  // A strip before the frontier behind a wall: 0.25 m from what the robot reaches, but not by its way.
  for (int y = 0; y < 40; ++y) map.cells[map.index({36, y})] = CellState::kOccupied;
  EXPECT_FALSE(approach_cell(map, find_frontiers(map).at(0), field_from(map, {10, 10}), 2.0));
}

/// The definition, over all cells: fewest steps, then nearest to the centroid.
TEST(ApproachCell, IsTheFewestStepsFromTheFrontier) {
  EXPECT_TRUE(rc::check([] {
    const DenseMap map = random_room(60);
    const auto start = map.cell(*rc::gen::inRange<std::size_t>(0, map.cells.size()));
    const grid::TravelField field = field_from(map, start);
    const double within_m = 0.05 * *rc::gen::inRange(0, 25);
    for (const Frontier& frontier : find_frontiers(map, 0.0)) {
      const std::vector<int> steps = steps_from(map, frontier.cells, true);
      const auto key = [&](std::size_t i) {
        return std::pair(steps[i], (map.centre_of(map.cell(i)) - frontier.centroid).squaredNorm());
      };
      std::optional<std::size_t> best;
      for (std::size_t i = 0; i < steps.size(); ++i) {
        const bool counts = steps[i] >= 0 && steps[i] <= static_cast<int>(within_m / map.resolution_m);
        if (counts && field.can_stay_at(i) && (!best || key(i) < key(*best))) best = i;
      }
      const auto found = approach_cell(map, frontier, field, within_m);
      RC_ASSERT(found.has_value() == best.has_value());
      if (found) RC_ASSERT(key(map.index(*found)) == key(*best));
    }
  }));
}

TEST(Middle, IsTheCellNearestToTheCentroid) {
  EXPECT_TRUE(rc::check([] {
    const DenseMap map = grid::filled_map(20, 15, CellState::kFree);
    std::vector<std::uint32_t> cells;
    for (int k = *rc::gen::inRange(1, 40); k > 0; --k)
      cells.push_back(*rc::gen::inRange<std::uint32_t>(0, static_cast<std::uint32_t>(map.cells.size())));
    types::Vector2 sum(0.0, 0.0);
    for (const std::uint32_t i : cells) sum += map.centre_of(map.cell(i));
    const types::Vector2 centroid = sum / static_cast<double>(cells.size());
    const auto away_m = [&](std::uint32_t i) { return (map.centre_of(map.cell(i)) - centroid).norm(); };
    const std::uint32_t middle = middle_of(map, cells);
    RC_ASSERT(std::ranges::count(cells, middle) > 0);
    for (const std::uint32_t i : cells) RC_ASSERT(away_m(middle) <= away_m(i) + 1e-12);
  }));
}

TEST(UnknownBehind, OfAnEnclosedPocketIsItsArea) {
  EXPECT_TRUE(rc::check([] {
    // A pocket behind a part of a room's right wall, and another one that nothing opens.
    const int width = *rc::gen::inRange(1, 20), height = *rc::gen::inRange(1, 20);
    places::DrawnMap drawn(100, 60);
    drawn.room(10, 10, 40, 40).occupied(40, 5, 70, 55);
    drawn.fill(40, 15, 40 + width, 15 + height, CellState::kUnknown)
        .fill(65, 15, 68, 18, CellState::kUnknown);
    const auto frontiers = find_frontiers(drawn.map(), 0.0);
    RC_ASSERT(frontiers.size() == 1U);
    RC_ASSERT(std::abs(unknown_behind_m2(drawn.map(), frontiers[0], 1.2) - 0.0025 * width * height) < 1e-9);
  }));
}

TEST(UnknownBehind, BeyondItsReachIsWithoutEnd) {
  // A pocket one cell high that goes on for some cells to the right of the frontier.
  for (const int depth : {1, 10, 23, 24, 25, 26, 40}) {
    places::DrawnMap drawn(100, 40);
    drawn.room(10, 10, 30, 30).occupied(30, 8, 80, 32).fill(30, 20, 30 + depth, 21, CellState::kUnknown);
    const auto frontiers = find_frontiers(drawn.map(), 0.0);
    ASSERT_EQ(frontiers.size(), 1U);
    const double behind_m2 = unknown_behind_m2(drawn.map(), frontiers[0], 1.2);
    EXPECT_EQ(std::isinf(behind_m2), depth > 24) << depth << " cells, of 1.2 m";
    if (depth > 24) continue;
    EXPECT_NEAR(behind_m2, 0.0025 * depth, 1e-9);
  }
}

TEST(UnknownBehind, NoFrontierIsNothing) {
  EXPECT_EQ(unknown_behind_m2(half_seen_room(40), Frontier{}, 1.2), 0.0);
}

}  // namespace
}  // namespace topo::goals
