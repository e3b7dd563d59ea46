// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/exploration/viewpoint.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/core/grid/maps.hpp"

namespace topo::exploration {
namespace {

using grid::CellIndex;
using grid::CellState;
using grid::DenseMap;
using types::Segment;

constexpr int kWidth = 120, kHeight = 80;  // 6 m by 4 m
constexpr int kWallX = 60, kGapFrom = 36, kGapTo = 43;

void fill(DenseMap& map, CellIndex from, CellIndex to, CellState state) {
  for (int y = from.y; y <= to.y; ++y)
    for (int x = from.x; x <= to.x; ++x) map.cells[map.index({x, y})] = state;
}

/// A room on the left; in its right wall a gap of 0.4 m, through which nothing was seen yet.
DenseMap room_with_gap() {
  DenseMap map = grid::filled_map(kWidth, kHeight, CellState::kUnknown);
  fill(map, {0, 0}, {kWallX, kHeight - 1}, CellState::kOccupied);
  fill(map, {1, 1}, {kWallX - 1, kHeight - 2}, CellState::kFree);
  fill(map, {kWallX, kGapFrom}, {kWallX, kGapTo}, CellState::kFree);
  return map;
}

goals::Frontier the_gap(const DenseMap& map) {
  for (const goals::Frontier& frontier : goals::find_frontiers(map, 0.3)) {
    if (std::abs(frontier.centroid.x() - 0.05 * kWallX) < 0.2) return frontier;
  }
  ADD_FAILURE() << "no frontier in the gap";
  return {};
}

/// Is what is between two points free, and then unknown?
bool is_line_of_sight(const DenseMap& map, const types::Vector2& a, const types::Vector2& b) {
  const double length_m = (b - a).norm();
  bool beyond = false;
  for (double s_m = 0.0; s_m < length_m; s_m += 0.01) {
    const CellState state = map.state(map.cell_at(a + (s_m / length_m) * (b - a)));
    if (state == CellState::kOccupied || (beyond && state == CellState::kFree)) return false;
    beyond = state == CellState::kUnknown;
  }
  return beyond;
}

/// From anywhere in a cell to the same point in another.
bool sees(const DenseMap& map, CellIndex from, CellIndex to) {
  for (const double dx : {0.0, -0.02, 0.02}) {
    for (const double dy : {0.0, -0.02, 0.02}) {
      const types::Vector2 by(dx, dy);
      if (is_line_of_sight(map, map.centre_of(from) + by, map.centre_of(to) + by)) return true;
    }
  }
  return false;
}

TEST(Viewpoint, IntoAGapThatIsTooNarrowForTheRobot) {
  const DenseMap map = room_with_gap();
  const auto field = field_from(map, {20, 40});
  const goals::Frontier gap = the_gap(map);
  ASSERT_LT(gap.width_m, 0.75);
  const auto look = find_viewpoint(map, gap, field, {});
  ASSERT_TRUE(look);
  EXPECT_TRUE(std::isfinite(field.cost_m[map.index(look->from)]));
  EXPECT_EQ(map.state(look->sight), CellState::kUnknown);
  EXPECT_TRUE(sees(map, look->from, look->sight));
  EXPECT_GT(look->gain_m2, 1.0);
}

TEST(Viewpoint, IsFromBesideWhatStandsBeforeTheGap) {
  DenseMap map = room_with_gap();
  fill(map, {40, 30}, {50, 49}, CellState::kOccupied);  // half a metre before the gap, wider than it
  const auto field = field_from(map, {20, 40});
  const goals::Frontier gap = the_gap(map);
  const auto look = find_viewpoint(map, gap, field, {});
  ASSERT_TRUE(look);
  EXPECT_TRUE(std::isfinite(field.cost_m[map.index(look->from)]));
  EXPECT_TRUE(sees(map, look->from, look->sight));
  const types::Vector2 from = map.centre_of(look->from);
  EXPECT_TRUE(from.y() < 0.05 * 30 || from.y() > 0.05 * 50) << "behind the cupboard: " << from.transpose();
}

TEST(Viewpoint, IsNoneWhereNobodyCanComeInSight) {
  DenseMap map = room_with_gap();
  fill(map, {30, 0}, {31, kHeight - 1}, CellState::kOccupied);
  EXPECT_FALSE(find_viewpoint(map, the_gap(map), field_from(map, {15, 40}), {}));
  EXPECT_TRUE(find_viewpoint(map, the_gap(map), field_from(map, {45, 20}), {}));
  EXPECT_FALSE(find_viewpoint(map, goals::Frontier{}, field_from(map, {45, 20}), {}));
}

TEST(Viewpoint, CountsNothingBehindAWallThatGoesOn) {
  const DenseMap map = room_with_gap();
  const auto field = field_from(map, {20, 40});
  const goals::Frontier gap = the_gap(map);
  const double open_m2 = find_viewpoint(map, gap, field, {})->gain_m2;
  // The wall of the next house, 0.4 m behind the gap: 0.3 m of unknown space before it.
  const double wall_x_m = 0.05 * (kWallX + 8);
  const std::vector<Segment> wall{{{wall_x_m, 0.0}, {wall_x_m, 4.0}}};
  const double closed_m2 = find_viewpoint(map, gap, field, wall)->gain_m2;
  EXPECT_LE(closed_m2, 0.4 * 4.0);
  EXPECT_LT(closed_m2, 0.5 * open_m2);
  // Of the same wall one metre was seen below and one above, and what is between not: it goes on over 0.8 m.
  const auto pieces = [&](double half_m) {
    return std::vector<Segment>{{{wall_x_m, 2.0 - half_m - 1.0}, {wall_x_m, 2.0 - half_m}},
                                {{wall_x_m, 2.0 + half_m}, {wall_x_m, 2.0 + half_m + 1.0}}};
  };
  const double bridged_m2 = find_viewpoint(map, gap, field, pieces(0.4))->gain_m2;
  EXPECT_LT(bridged_m2, 0.5 * open_m2);
  EXPECT_GT(find_viewpoint(map, gap, field, pieces(0.9))->gain_m2, 1.5 * bridged_m2);
  auto turned = pieces(0.4);
  std::swap(turned[0], turned[1]);
  EXPECT_EQ(find_viewpoint(map, gap, field, turned)->gain_m2, bridged_m2);
}

TEST(Viewpoint, ReachesNoFartherThanItIsTold) {
  const DenseMap map = room_with_gap();
  const auto field = field_from(map, {20, 40});
  const goals::Frontier gap = the_gap(map);
  ViewpointParams params;
  params.reach_m = 0.2;  // nearer than the robot's disc comes to the wall
  EXPECT_FALSE(find_viewpoint(map, gap, field, {}, params));
  params.reach_m = 1.0;
  const auto look = find_viewpoint(map, gap, field, {}, params);
  ASSERT_TRUE(look);
  EXPECT_LE((map.centre_of(look->from) - gap.centroid).norm(), 1.0 + 0.4);
}

}  // namespace
}  // namespace topo::exploration
