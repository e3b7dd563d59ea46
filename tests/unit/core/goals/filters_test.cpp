// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/filters.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "tests/unit/core/goals/scene.hpp"
#include "tests/unit/core/grid/maps.hpp"

namespace topo::goals {
namespace {

using grid::CellIndex;
using grid::CellState;
using grid::DenseMap;

/// A map in which most cells are free, one by one.
DenseMap speckled_map() {
  DenseMap map = grid::filled_map(*rc::gen::inRange(1, 14), *rc::gen::inRange(1, 14), CellState::kFree);
  for (CellState& cell : map.cells)
    if (*rc::gen::inRange(0, 8) == 0) cell = *rc::gen::element(CellState::kOccupied, CellState::kUnknown);
  return map;
}

CellIndex random_cell(const DenseMap& map) {
  return map.cell(*rc::gen::inRange<std::size_t>(0, map.cells.size()));
}

/// Cells between the ends for which, in the middle of their column or row, the line is inside of them.
std::vector<CellIndex> crossed_cells(CellIndex a, CellIndex b) {
  std::vector<CellIndex> cells;
  const int dx = b.x - a.x, dy = b.y - a.y, steps = std::max(std::abs(dx), std::abs(dy));
  const auto rounded = [&](int d, int k) { return static_cast<int>(std::lround(1.0 * d * k / steps)); };
  for (int k = 1; k < steps; ++k) {
    const bool on_side =
        2 * std::abs(dx * k) % (2 * steps) == steps || 2 * std::abs(dy * k) % (2 * steps) == steps;
    if (!on_side) cells.push_back({a.x + rounded(dx, k), a.y + rounded(dy, k)});
  }
  return cells;
}

/// Does the line between the centres of `a` and `b` touch the square of a cell? In quarters of cells.
bool touches(CellIndex a, CellIndex b, CellIndex c) {
  const int dx = b.x - a.x, dy = b.y - a.y;
  int low = 0, high = 0;
  for (const int u : {-1, 1}) {
    for (const int v : {-1, 1}) {
      const int side = dx * (2 * (c.y - a.y) + v) - dy * (2 * (c.x - a.x) + u);
      low = std::min(low, side);
      high = std::max(high, side);
    }
  }
  const bool beside = c.x < std::min(a.x, b.x) || c.x > std::max(a.x, b.x) || c.y < std::min(a.y, b.y) ||
                      c.y > std::max(a.y, b.y);
  return low <= 0 && high >= 0 && !beside;
}

TEST(Sees, NothingThroughACellThatTheLineCrosses) {
  EXPECT_TRUE(rc::check([] {
    const DenseMap map = speckled_map();
    const CellIndex a = random_cell(map), b = random_cell(map);
    if (!sees(map, a, b)) return;
    for (const CellIndex c : crossed_cells(a, b)) RC_ASSERT(map.state(c) == CellState::kFree);
  }));
}

TEST(Sees, WhereAllThatTheLineTouchesIsFree) {
  EXPECT_TRUE(rc::check([] {
    const DenseMap map = speckled_map();
    const CellIndex a = random_cell(map), b = random_cell(map);
    bool is_open = true;
    for (std::size_t i = 0; i < map.cells.size(); ++i)
      is_open = is_open && (map.cells[i] == CellState::kFree || !touches(a, b, map.cell(i)));
    if (is_open) RC_ASSERT(sees(map, a, b));
  }));
}

TEST(Sees, AlongRowsAndColumnsBothWaysTheSame) {
  EXPECT_TRUE(rc::check([] {
    const DenseMap map = speckled_map();
    const CellIndex a = random_cell(map), other = random_cell(map);
    for (const CellIndex b : {CellIndex{a.x, other.y}, CellIndex{other.x, a.y}}) {
      bool is_open = true;
      for (int x = std::min(a.x, b.x); x <= std::max(a.x, b.x); ++x)
        for (int y = std::min(a.y, b.y); y <= std::max(a.y, b.y); ++y)
          is_open = is_open && map.state({x, y}) == CellState::kFree;
      if (is_open) RC_ASSERT(sees(map, a, b) && sees(map, b, a));
      for (const CellIndex c : crossed_cells(a, b))
        if (map.state(c) != CellState::kFree) RC_ASSERT(!sees(map, a, b) && !sees(map, b, a));
    }
  }));
}

TEST(Sees, ItsOwnCellWhateverThatIs) {
  const DenseMap map = grid::drawn_map({"#?.", "..."});
  for (std::size_t i = 0; i < map.cells.size(); ++i) EXPECT_TRUE(sees(map, map.cell(i), map.cell(i))) << i;
}

TEST(Sees, NothingBeyondTheEdgeOfTheMap) {
  const DenseMap map = grid::drawn_map({"....", "....", "...."});
  EXPECT_TRUE(sees(map, {0, 0}, {3, 2}));
  EXPECT_FALSE(sees(map, {0, 0}, {9, 0}));
  EXPECT_FALSE(sees(map, {-4, 1}, {3, 1}));
}

Goal goal_at(const types::Vector2& p_map, double opening_m) {
  Goal goal;
  goal.p_map = p_map;
  goal.opening_m = opening_m;
  return goal;
}

TEST(IsVisited, AtANarrowOpeningOnePoseIsEnough) {
  EXPECT_TRUE(rc::check([] {
    const auto paths = random_paths(2.0);
    const Goal goal = goal_at(random_point(1.0), 0.01 * *rc::gen::inRange(75, 150));
    bool was_near = false;
    for (const auto& path : paths)
      for (const types::Vector2& p : path) was_near = was_near || (p - goal.p_map).norm() < 1.0;
    RC_ASSERT(is_visited(goal, paths, {}) == was_near);
  }));
}

TEST(IsVisited, AtAWideOneTheWayWithinTheRadiusCounts) {
  // Straight through the middle in steps of 0.1 m: 1.8 m between poses that are nearer than a metre.
  const auto through = [](double from_x, double to_x) {
    std::vector<types::Vector2> path;
    for (double x = from_x; x < to_x + 0.01; x += 0.1) path.emplace_back(x, 0.0);
    return path;
  };
  const auto visits = [](const std::vector<std::vector<types::Vector2>>& paths, double opening_m) {
    return is_visited(goal_at({0.0, 0.0}, opening_m), paths, {});
  };
  EXPECT_TRUE(visits({through(-3.0, 3.0)}, 1.5));
  EXPECT_TRUE(visits({through(-0.65, 0.65)}, 1.5));
  EXPECT_FALSE(visits({through(-0.55, 0.55)}, 1.5)) << "1.1 m";
  EXPECT_TRUE(visits({through(-0.85, -0.15), through(0.15, 0.85)}, 1.5)) << "in sum";
  EXPECT_FALSE(visits({through(0.0, 0.0)}, 1.5));
  EXPECT_TRUE(visits({through(0.0, 0.0)}, 1.49)) << "not wide";
}

TEST(IsVisited, MorePosesNeverMakeItNew) {
  EXPECT_TRUE(rc::check([] {
    auto paths = random_paths(1.5);
    const Goal goal = goal_at(random_point(1.0), 0.1 * *rc::gen::inRange(7, 30));
    const bool before = is_visited(goal, paths, {});
    paths.emplace_back();
    for (int k = *rc::gen::inRange(0, 6); k > 0; --k) paths.back().push_back(random_point(1.5));
    if (before) RC_ASSERT(is_visited(goal, paths, {}));
    std::ranges::reverse(paths);
    const bool now = is_visited(goal, paths, {});
    for (auto& path : paths) std::ranges::reverse(path);
    RC_ASSERT(is_visited(goal, paths, {}) == now);
  }));
}

/// Two squares of 3 m side by side with 0.2 m between them, drawn as places 1 and 2.
struct TwoSquares {
  explicit TwoSquares(int gap_cells = 4)
      : map(places::DrawnMap(140, 70).free(0, 0, 60, 60).free(60 + gap_cells, 0, 120, 60).map()) {
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      if (map.cells[i] != CellState::kFree) continue;
      const auto label = static_cast<std::uint16_t>(map.cell(i).x < 60 ? 1 : 2);
      places.labels.append(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(i + 1), label);
    }
    places.places.push_back({{{0.0, 0.0}, {3.0, 3.0}}, {1.5, 1.5}, 9.0, 1.5F});
    places.places.push_back({{{0.05 * (60 + gap_cells), 0.0}, {6.0, 3.0}}, {4.6, 1.5}, 8.4, 1.4F});
  }
  [[nodiscard]] bool faces(std::uint16_t place, Side side) const {
    return faces_another_place({map, {}, skeleton, places, {}, {}}, place, side, {});
  }

  DenseMap map;
  places::Skeleton skeleton;
  places::PlaceMap places;
};

TEST(FacesAnotherPlace, IsTrueOfTheSidesBetweenTwoPlacesAlone) {
  const TwoSquares squares;
  for (const Side side : {Side::kEast, Side::kNorth, Side::kWest, Side::kSouth}) {
    EXPECT_EQ(squares.faces(1, side), side == Side::kEast) << to_text(side);
    EXPECT_EQ(squares.faces(2, side), side == Side::kWest) << to_text(side);
  }
}

TEST(FacesAnotherPlace, ReachesHalfAMetre) {
  EXPECT_TRUE(TwoSquares(8).faces(1, Side::kEast));
  EXPECT_FALSE(TwoSquares(12).faces(1, Side::kEast));
}

TEST(FacesAnotherPlace, InTheCompassFrameNotTheMaps) {
  // The compass frame is the map turned by -90 degrees: its x is the map's y, its y the map's -x.
  TwoSquares squares;
  squares.places.compass_rad = 0.5 * std::numbers::pi;
  squares.places.places[0].box = {{0.0, -3.0}, {3.0, 0.0}};
  squares.places.places[1].box = {{0.0, -6.0}, {3.0, -3.2}};
  for (const Side side : {Side::kEast, Side::kNorth, Side::kWest, Side::kSouth}) {
    EXPECT_EQ(squares.faces(1, side), side == Side::kSouth) << to_text(side);
    EXPECT_EQ(squares.faces(2, side), side == Side::kNorth) << to_text(side);
  }
}

TEST(DistanceFromPaths, IsThatOfTheNearestPoseOfAny) {
  const std::vector<std::vector<types::Vector2>> paths = {{{0.0, 0.0}, {4.0, 0.0}}, {}, {{9.0, 3.0}}};
  EXPECT_DOUBLE_EQ(distance_from_paths_m({6.0, 0.0}, paths), 2.0);
  EXPECT_DOUBLE_EQ(distance_from_paths_m({9.0, 4.0}, paths), 1.0);
  EXPECT_EQ(distance_from_paths_m({9.0, 4.0}, {}), HUGE_VAL);
}

TEST(DistanceFromPaths, IsTheSameHoweverTheMapIsTurned) {
  EXPECT_TRUE(rc::check([] {
    auto paths = random_paths(9.0);
    const types::Vector2 p = random_point(9.0);
    double nearest_m = HUGE_VAL;
    for (const auto& path : paths)
      for (const types::Vector2& pose : path) nearest_m = std::min(nearest_m, (pose - p).norm());
    const types::Se2 motion{3.0, -2.0, 0.01 * *rc::gen::inRange(-314, 314)};
    const double away_m = distance_from_paths_m(p, paths);
    for (auto& path : paths)
      for (types::Vector2& pose : path) pose = motion * pose;
    std::ranges::reverse(paths);
    const double moved_m = distance_from_paths_m(motion * p, paths);
    if (std::isinf(nearest_m)) {
      RC_ASSERT(away_m == HUGE_VAL && moved_m == HUGE_VAL);
    } else {
      RC_ASSERT(std::abs(away_m - nearest_m) < 1e-9 && std::abs(moved_m - away_m) < 1e-9);
    }
  }));
}

}  // namespace
}  // namespace topo::goals
