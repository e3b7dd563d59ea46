// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/travel/travel_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/grid/distance.hpp"
#include "core/grid/occupancy_grid.hpp"
#include "core/grid/wavefront.hpp"
#include "tests/unit/core/grid/maps.hpp"
#include "tests/unit/core/motion/generators.hpp"
#include "tests/unit/core/travel/counted_cells.hpp"
#include "tests/unit/core/travel/drawn_map.hpp"

namespace topo::travel {
namespace {

using ::testing::ElementsAreArray;
using Rows = std::vector<std::string>;

TEST(CloseGaps, stripesBetweenBeamsAreNoFrontier) {
  grid::DenseMap map = drawn_map({"            ",  //
                                  "  ........  ",  //
                                  "            ",  //
                                  "  ........  ",  //
                                  "            ",  //
                                  "            "});
  close_gaps(map, 2);
  // Between the stripes all is free; beyond them nothing was seen.
  EXPECT_THAT(text_of(map), ElementsAreArray(Rows{"            ",  //
                                                  "  ........  ",  //
                                                  "  ........  ",  //
                                                  "  ........  ",  //
                                                  "            ",  //
                                                  "            "}));
}

TEST(CloseGaps, aWallBetweenStaysClosedAndWideGapsStay) {
  const Rows rows{"              ",  //
                  "  ..#  ....   ",  //
                  "  ..#  ....   ",  //
                  "              ",  //
                  "              "};
  grid::DenseMap map = drawn_map(rows);
  close_gaps(map, 2);
  EXPECT_THAT(text_of(map), ElementsAreArray(rows));
}

/// Is the next known cell that way free, within reach?
bool sees_free(const grid::DenseMap& map, grid::CellIndex from, grid::CellIndex step, int reach) {
  for (int k = 1; k <= reach; ++k) {
    const grid::CellState state = map.state({from.x + k * step.x, from.y + k * step.y});
    if (state != grid::CellState::kUnknown) return state == grid::CellState::kFree;
  }
  return false;
}

TEST(CloseGaps, closesWhatLiesBetweenFreeCellsInMapsOfAnySize) {
  EXPECT_TRUE(rc::check([] {
    const int reach = *rc::gen::inRange(1, 4);
    grid::DenseMap map =
        grid::filled_map(*rc::gen::inRange(1, 150), *rc::gen::inRange(1, 12), grid::CellState::kUnknown);
    for (int known = *rc::gen::inRange(0, 200); known > 0; --known) {
      map.cells[*rc::gen::inRange<std::size_t>(0, map.cells.size())] =
          *rc::gen::element(grid::CellState::kFree, grid::CellState::kFree, grid::CellState::kOccupied);
    }
    const grid::DenseMap before = map;
    close_gaps(map, reach);
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      const grid::CellIndex c = map.cell(i);
      const bool inside = c.x - map.box.min.x >= reach && map.box.max.x - c.x >= reach &&
                          c.y - map.box.min.y >= reach && map.box.max.y - c.y >= reach;
      bool between = false;
      for (std::size_t d = 0; d < 4; ++d) {
        const grid::CellIndex there = grid::kNeighbours[d], back{-there.x, -there.y};
        between = between || (sees_free(before, c, there, reach) && sees_free(before, c, back, reach));
      }
      const bool closes = inside && between && before.cells[i] == grid::CellState::kUnknown;
      RC_ASSERT(map.cells[i] == (closes ? grid::CellState::kFree : before.cells[i]));
    }
  }));
}

TEST(FreeDisc, takesUnknownCellsOnly) {
  grid::DenseMap map = drawn_map({"     ", "  #  ", "     ", "     ", "     "}, 1.0);
  free_disc(map, {2.5, 2.5}, 1.1);
  EXPECT_THAT(text_of(map), ElementsAreArray(Rows{"     ", "  #  ", " ... ", "  .  ", "     "}));
}

TEST(FreeDisc, leavesTheBorderUnknown) {
  grid::DenseMap map = drawn_map({"     ", "     ", "     ", "     ", "     "}, 1.0);
  free_disc(map, {0.5, 2.5}, 2.6);
  EXPECT_THAT(text_of(map), ElementsAreArray(Rows{"     ", " ..  ", " ..  ", " ..  ", "     "}));
}

TEST(OccupyFaint, aTenthAndTwiceAtLeast) {
  grid::DenseMap map = drawn_map({"......"});
  CountedCells counted;
  counted.put({0, 0}, 2, 18);   // a tenth
  counted.put({1, 0}, 2, 19);   // less
  counted.put({2, 0}, 1, 0);    // once
  counted.put({3, 0}, 20, 20);  // half
  counted.put({4, 0}, 0, 30);
  counted.put({40, 0}, 9, 0);  // outside the map
  occupy_faint(map, counted.grid(), {});
  EXPECT_THAT(text_of(map), ElementsAreArray(Rows{"#..#.."}));
}

/// A wall to the left of the robot, and nothing in range to its right.
TEST(PrepareMap, theDiscAtTheMapsEdgeIsFreeTheBorderIsNot) {
  CountedCells counted;
  for (int x = 0; x < 32; ++x) counted.put({x, 31}, 5, 0);
  for (int x = 0; x < 32; ++x) counted.put({x, 0}, 0, 5);
  const std::vector<types::KeyframePose> way = {
      {types::Stamp{}, types::Transform2<types::Map, types::Base>(0.8, 0.0, 0.0)}};
  constexpr double kRoute_m = 0.95;
  const grid::DenseMap map = prepare_map(counted.grid(), {way, {}}, {}, kRoute_m, {});
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const double away_m = (map.centre_of(map.cell(i)) - types::Vector2(0.8, 0.0)).norm();
    if (map.is_on_border(map.cell(i))) {
      EXPECT_EQ(map.cells[i], grid::CellState::kUnknown);
    } else if (away_m <= kRoute_m) {
      EXPECT_EQ(map.cells[i], grid::CellState::kFree);
    }
  }
  EXPECT_EQ(map.state(map.cell_at({0.8, -0.9})), grid::CellState::kFree);
}

types::KeyframePose station(double x_m, double y_m) {
  return {types::Stamp{}, types::Transform2<types::Map, types::Base>(x_m, y_m, 0.0)};
}

TEST(PrepareMap, ARobotWhereATeamMateBeganIsNoWall) {
  CountedCells counted;
  for (int x = 0; x < 60; ++x)
    for (int y = 0; y < 20; ++y) counted.put({x, y}, 0, 20);
  const auto see_wall = [&](int x, int y) { counted.put({x, y}, 20, 0); };
  see_wall(36, 10);  // 0.325 m from the mate's start, as its outline with the range's noise
  see_wall(38, 10);  // 0.425 m
  const std::vector<types::KeyframePose> own{station(0.525, 0.525)};
  const std::vector<std::vector<types::KeyframePose>> mates{{station(1.525, 0.525), station(1.925, 0.525)}};
  const auto states = [&](const DrivenWays& ways) {
    const grid::DenseMap map = prepare_map(counted.grid(), ways, {}, 0.297, {});
    return std::pair(map.state({36, 10}), map.state({38, 10}));
  };
  using grid::CellState;
  EXPECT_EQ(states({own, mates}), std::pair(CellState::kFree, CellState::kOccupied));
  EXPECT_EQ(states({own, {}}), std::pair(CellState::kOccupied, CellState::kOccupied)) << "a robot alone";
}

/// Floor on both sides of a wall one cell thick, that is so many cells beside the start of a robot with
/// mates.
TEST(PrepareMap, NoRouteLeadsThroughAWallBesideWhichARobotBegan) {
  for (const int away : {4, 5, 6, 7, 8}) {  // from 0.2 m, half of a P3-DX's width
    CountedCells counted;
    for (int x = 0; x < 60; ++x)
      for (int y = 0; y < 60; ++y) counted.put({x, y}, y == 30 ? 20 : 0, y == 30 ? 0 : 20);
    const std::vector<types::KeyframePose> own{station(1.525, 1.525 - 0.05 * away)};
    const std::vector<std::vector<types::KeyframePose>> mates(1);
    const grid::DenseMap map = prepare_map(counted.grid(), {own, mates}, {}, 0.297, {});
    const std::vector<float> clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
    const auto reaches = [&](const types::Vector2& from) {
      const grid::TravelField field = grid::travel_field(map, clearance_m, map.cell_at(from), {});
      return std::isfinite(field.cost_m[map.index({30, 45})]);
    };
    EXPECT_FALSE(reaches({1.525, 0.5})) << away;
    EXPECT_TRUE(reaches({0.5, 2.5}));
  }
}

TEST(FreeTrail, whereTheRobotStoodASuspicionIsNone) {
  grid::DenseMap map = drawn_map({"#####"});
  CountedCells counted;
  counted.put({1, 0}, 2, 18);  // faint
  counted.put({2, 0}, 18, 2);  // seen well
  counted.put({4, 0}, 2, 18);  // faint, and not where the robot stood
  free_trail(map, counted.grid(), map.centre_of({1, 0}), 0.06);
  EXPECT_THAT(text_of(map), ElementsAreArray(Rows{"..###"}));
}

TEST(KeepTrailOpen, whereTheRobotWentItCanGoBack) {
  Rows rows(20, std::string(40, '.'));
  rows[9][6] = '#';  // (6, 10), on the way
  const grid::DenseMap map = drawn_map(rows, 0.1);
  std::vector<float> clearance(map.cells.size(), 0.0F);
  clearance[map.index({7, 10})] = 0.9F;
  const std::vector<types::KeyframePose> way{station(0.35, 1.05), station(1.05, 1.05), station(3.05, 1.05)};
  keep_trail_open(map, way, {39, 19}, {0.33}, clearance);
  for (const int x : {3, 4, 5, 8, 9, 10}) {
    EXPECT_FLOAT_EQ(clearance[map.index({x, 10})], 0.33F) << x;
    EXPECT_FLOAT_EQ(clearance[map.index({x, 11})], 0.0F) << x << ": no wider than its line";
  }
  EXPECT_FLOAT_EQ(clearance[map.index({6, 10})], 0.0F) << "occupied";
  EXPECT_FLOAT_EQ(clearance[map.index({7, 10})], 0.9F) << "never lowered";
  EXPECT_FLOAT_EQ(clearance[map.index({20, 10})], 0.0F) << "carried from one to the next";
}

TEST(KeepTrailOpen, noFartherThanToldAndOnlyWhereItIsHardlyShut) {
  const grid::DenseMap map = drawn_map(Rows(20, std::string(60, '.')), 0.1);
  std::vector<float> clearance(map.cells.size(), 0.26F);
  clearance[map.index({6, 10})] = 0.2F;
  std::vector<types::KeyframePose> way(10);
  for (std::size_t i = 0; i < way.size(); ++i) way[i] = station(0.35 + 0.5 * static_cast<double>(i), 1.05);
  keep_trail_open(map, way, {3, 10}, {0.27, 0.25, 3.2}, clearance);
  EXPECT_FLOAT_EQ(clearance[map.index({4, 10})], 0.27F);
  EXPECT_FLOAT_EQ(clearance[map.index({6, 10})], 0.2F) << "something is there";
  EXPECT_FLOAT_EQ(clearance[map.index({30, 10})], 0.27F);
  EXPECT_FLOAT_EQ(clearance[map.index({37, 10})], 0.26F) << "far off";
}

/// In a team the second robot stands 1.3 m ahead, and walls are near: who stood still at its start for two
/// keyframes never left it.
TEST(KeepTrailOpen, whereTheRobotStandsItLeavesOverWhatIsAroundIt) {
  const grid::DenseMap map = grid::filled_map(80, 11, grid::CellState::kFree);  // 0.55 m wide
  const std::vector<float> narrow_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
  const std::vector<types::KeyframePose> way{station(0.32, 0.28), station(0.33, 0.28)};
  const grid::CellIndex here = map.cell_at(way.back().T_map_base.se2().translation());
  const grid::TravelRules rules;
  const auto reached = [&](const std::vector<float>& clearance_m) {
    const grid::TravelField field = grid::travel_field(map, clearance_m, here, rules);
    return std::count_if(field.cost_m.begin(), field.cost_m.end(), [](float c) { return std::isfinite(c); });
  };
  std::vector<float> clearance_m = narrow_m;
  keep_trail_open(map, way, here, {rules.radius_m}, clearance_m);
  EXPECT_GE(reached(clearance_m), reached(narrow_m));
  EXPECT_GT(reached(clearance_m), 50);
}

TEST(ApplyLimits, outsideAndKeepOutAreWalls) {
  grid::DenseMap map = drawn_map({"......", "......", "......", "......"}, 1.0);
  types::AreaLimits limits;
  limits.keep_in = types::Polygon{{1.0, 0.0}, {6.0, 0.0}, {6.0, 3.0}, {1.0, 3.0}};
  limits.keep_out.push_back({{3.0, 1.0}, {5.0, 1.0}, {5.0, 2.0}, {3.0, 2.0}});
  apply_limits(map, limits);
  EXPECT_THAT(text_of(map), ElementsAreArray(Rows{"######", "#.....", "#..##.", "#....."}));
}

TEST(ApplyLimits, OccupiesWhatThePolygonsDoNotAllow) {
  EXPECT_TRUE(rc::check([] {
    using motion::uniform;
    const auto any_corners = [] {
      types::Polygon polygon;
      for (int corners = *rc::gen::inRange(3, 7); corners > 0; --corners)
        polygon.emplace_back(uniform(-0.3, 1.5), uniform(-0.3, 1.5));
      return polygon;
    };
    types::AreaLimits limits;
    if (*rc::gen::arbitrary<bool>()) limits.keep_in = any_corners();
    for (int holes = *rc::gen::inRange(0, 3); holes > 0; --holes) limits.keep_out.push_back(any_corners());
    const grid::DenseMap before = grid::random_map(24);
    grid::DenseMap map = before;
    apply_limits(map, limits);
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      const bool allowed = types::allows(limits, map.centre_of(map.cell(i)));
      RC_ASSERT(map.cells[i] == (allowed ? before.cells[i] : grid::CellState::kOccupied));
    }
  }));
}

TEST(FreeDisc, AndNoOtherCellIsFreed) {
  EXPECT_TRUE(rc::check([] {
    using motion::uniform;
    const grid::DenseMap before = grid::random_map(30);
    const types::Vector2 centre{uniform(-0.5, 2.0), uniform(-0.5, 2.0)};
    const double radius_m = uniform(0.0, 0.8);
    grid::DenseMap map = before;
    for (int again = 0; again < 2; ++again) free_disc(map, centre, radius_m);
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      const bool within = (map.centre_of(map.cell(i)) - centre).norm() <= radius_m;
      const bool takes =
          within && before.cells[i] == grid::CellState::kUnknown && !map.is_on_border(map.cell(i));
      RC_ASSERT(map.cells[i] == (takes ? grid::CellState::kFree : before.cells[i]));
    }
  }));
}

TEST(LowerClearance, IsTheDistanceToTheNearestObstacleInReach) {
  EXPECT_TRUE(rc::check([] {
    using motion::uniform;
    const grid::DenseMap map = grid::filled_map(24, 18, grid::CellState::kFree);
    const std::vector<float> before = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
    std::vector<types::Vector2> obstacles;
    for (int count = *rc::gen::inRange(0, 5); count > 0; --count)
      obstacles.push_back(map.centre_of({*rc::gen::inRange(0, 24), *rc::gen::inRange(0, 18)}));
    const double reach_m = uniform(0.01, 0.7);
    std::vector<float> clearance = before, backwards = before;
    lower_clearance(map, obstacles, reach_m, clearance);
    std::vector<float> twice = clearance;
    lower_clearance(map, obstacles, reach_m, twice);
    RC_ASSERT(twice == clearance);
    std::reverse(obstacles.begin(), obstacles.end());
    lower_clearance(map, obstacles, reach_m, backwards);
    RC_ASSERT(backwards == clearance);
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      double expected_m = static_cast<double>(before[i]);
      for (const types::Vector2& p : obstacles) {
        const double away_m = (map.centre_of(map.cell(i)) - p).norm();
        if (away_m <= reach_m) expected_m = std::min(expected_m, away_m);
      }
      RC_ASSERT(std::abs(static_cast<double>(clearance[i]) - expected_m) < 1e-6);
    }
  }));
}

TEST(LowerClearance, WhatIsOutsideTheMapIsNoObstacle) {
  const grid::DenseMap map = grid::filled_map(10, 10, grid::CellState::kFree);
  const std::vector<float> before(map.cells.size(), 1.0F);
  std::vector<float> clearance = before;
  lower_clearance(map, std::vector<types::Vector2>{{-1.0, 0.2}, {50.0, 50.0}}, 2.0, clearance);
  EXPECT_EQ(clearance, before);
}

TEST(LowerClearance, neverRaisesAndReachesAsFarAsTold) {
  const grid::DenseMap map = drawn_map(Rows(20, std::string(20, '.')), 0.1);
  std::vector<float> clearance(map.cells.size(), 0.3F);
  clearance[map.index({10, 10})] = 0.5F;
  lower_clearance(map, std::vector<types::Vector2>{map.centre_of({10, 12})}, 0.25, clearance);
  EXPECT_FLOAT_EQ(clearance[map.index({10, 12})], 0.0F);
  EXPECT_NEAR(clearance[map.index({10, 10})], 0.2, 1e-6);
  EXPECT_FLOAT_EQ(clearance[map.index({10, 8})], 0.3F);
  for (const float c : clearance) EXPECT_LE(c, 0.5F);
}

TEST(KeepTrailOpen, OpensFreeCellsOfTheLinesAloneAndLowersNone) {
  EXPECT_TRUE(rc::check([] {
    using motion::uniform;
    const grid::DenseMap map = grid::random_map(40);
    const std::vector<float> before = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
    std::vector<types::KeyframePose> way;
    types::Vector2 at{uniform(0.0, 2.0), uniform(0.0, 2.0)};
    for (int stations = *rc::gen::inRange(0, 6); stations > 0; --stations) {
      way.push_back(station(at.x(), at.y()));
      at += types::Vector2(uniform(-0.5, 0.5), uniform(-0.5, 0.5));
    }
    const grid::CellIndex here{*rc::gen::inRange(-5, 45), *rc::gen::inRange(-5, 45)};
    const TrailRules rules{0.4, *rc::gen::element(0.0, 0.1)};
    std::vector<float> clearance = before;
    keep_trail_open(map, way, here, rules, clearance);
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      double off_m = HUGE_VAL;  // from the trail
      for (std::size_t k = 1; k < way.size(); ++k) {
        const types::Vector2 a = way[k - 1].T_map_base.se2().translation(),
                             b = way[k].T_map_base.se2().translation(), p = map.centre_of(map.cell(i));
        const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
        off_m = std::min(off_m, (a + t * (b - a) - p).norm());
      }
      const bool may_open = map.cells[i] == grid::CellState::kFree && map.cell(i) != here &&
                            static_cast<double>(before[i]) >= rules.above_m - 1e-6;
      const float open_m = std::max(before[i], 0.4F);
      if (may_open && off_m < 0.01) RC_ASSERT(clearance[i] == open_m);
      if (!may_open || off_m > 0.0376) RC_ASSERT(clearance[i] == before[i]);
      RC_ASSERT((clearance[i] == before[i] || clearance[i] == open_m));
    }
  }));
}

TEST(ConfirmedPoints, LieWhereTheBeamsEndWhereverTheLaserIs) {
  EXPECT_TRUE(rc::check([] {
    using motion::uniform;
    types::Scan scan;
    scan.beams = static_cast<std::uint16_t>(*rc::gen::inRange(0, 80));
    scan.geometry.angle_min_rad = -1.5F;
    scan.geometry.angle_increment_rad = 0.04F;
    for (std::size_t i = 0; i < scan.beams; ++i) {
      const float range_m = static_cast<float>(uniform(1.0, 1.0 + 0.2 * *rc::gen::inRange(0, 3)));
      scan.range_m[i] = *rc::gen::element(range_m, range_m, range_m, range_m, types::kNoReturn);
    }
    const types::Se2 at{uniform(-5.0, 5.0), uniform(-5.0, 5.0), uniform(-3.0, 3.0)};
    const double most_m = uniform(1.0, 1.5);
    std::vector<types::Vector2> expected;
    for (std::size_t i = 1; i + 1 < scan.beams; ++i) {
      const auto fits = [&](std::size_t k) { return std::abs(scan.range_m[k] - scan.range_m[i]) < 0.1F; };
      const double range_m = static_cast<double>(scan.range_m[i]),
                   angle = static_cast<double>(scan.angle_rad(i));
      if (!types::is_hit(scan.range_m[i]) || range_m > most_m || !fits(i - 1) || !fits(i + 1)) continue;
      expected.push_back(at * types::Vector2(range_m * std::cos(angle), range_m * std::sin(angle)));
    }
    const auto points = confirmed_points(scan, at, most_m, RouteMapParams{}.live_step_m);
    RC_ASSERT(points.size() == expected.size());
    for (std::size_t i = 0; i < points.size(); ++i) RC_ASSERT((points[i] - expected[i]).norm() < 1e-5);
  }));
}

TEST(ConfirmedPoints, loneEchoesAreNoObstacles) {
  types::Scan scan;
  scan.beams = 9;
  scan.geometry.angle_min_rad = -0.04F;
  scan.geometry.angle_increment_rad = 0.01F;
  scan.range_m = {2.0F, 2.0F, 2.0F, 1.0F, 2.0F, 2.0F, types::kInvalid, 2.0F, 9.0F};
  const auto points = confirmed_points(scan, {0.0, 0.0, 0.0}, 5.0, RouteMapParams{}.live_step_m);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_NEAR(points.front().norm(), 2.0, 1e-6);
}

}  // namespace
}  // namespace topo::travel
