// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/travel/seen_through.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace topo::travel {
namespace {

using types::Vector2;
using Way = std::vector<types::KeyframePose>;

types::KeyframePose stood_at(double x_m, double y_m) {
  return {types::Stamp{}, types::Transform2<types::Map, types::Base>(x_m, y_m, 0.0)};
}

/// 270 beams, 135 degrees to either side, all of one range.
types::Scan scan_of(float range_m) {
  types::Scan scan;
  scan.beams = 271;
  scan.geometry.angle_min_rad = -2.3562F;
  scan.geometry.angle_increment_rad = 0.017453F;
  std::fill_n(scan.range_m.begin(), scan.beams, range_m);
  return scan;
}

constexpr double kFloorCell_m = 0.05;

/// 8 by 8 m around the scanner, all free.
grid::DenseMap floor() {
  grid::DenseMap map;
  map.resolution_m = kFloorCell_m;
  map.box = {{-80, -80}, {79, 79}};
  map.cells.assign(160UL * 160UL, grid::CellState::kFree);
  return map;
}

/// Occupied from x to x, 0.4 m wide.
grid::DenseMap with_obstacle(double from_m, double to_m, double half_width_m = 0.2) {
  grid::DenseMap map = floor();
  for (double x = from_m + 0.5 * kFloorCell_m; x < to_m; x += kFloorCell_m)
    for (double y = -half_width_m + 0.5 * kFloorCell_m; y < half_width_m; y += kFloorCell_m)
      map.cells[map.index(map.cell_at({x, y}))] = grid::CellState::kOccupied;
  return map;
}

const grid::DenseMap kStander = with_obstacle(1.2, 1.6);
const grid::DenseMap kWall = with_obstacle(1.2, 1.6, 2.0);
const Way kAhead{stood_at(0.9, 0.0), stood_at(1.3, 0.0), stood_at(1.7, 0.0)};

std::vector<Vector2> seen(const types::Scan& scan, const grid::DenseMap& map, const Way& own = {},
                          const std::vector<Way>& mates = {}, const types::Se2& at = {}) {
  return seen_through(scan, at, map, {own, mates}, {});
}

TEST(SeenThrough, WhereSomebodyStoodIsFreeToWhoSeesTheWallBehind) {
  EXPECT_EQ(seen(scan_of(3.0F), kStander).size(), 64U);
  EXPECT_TRUE(seen(scan_of(1.2F), kStander).empty()) << "they still stand there";
  for (const Vector2& p : seen(scan_of(1.6F), kStander)) EXPECT_LT(p.norm(), 1.45 + 1e-6) << "noise";
}

TEST(SeenThrough, OfAWallOnlyWhatIsOnAWayMayBeFree) {
  EXPECT_TRUE(seen(scan_of(3.0F), kWall).empty()) << "glass";
  const auto own = seen(scan_of(3.0F), kWall, kAhead);
  ASSERT_FALSE(own.empty());
  for (const Vector2& p : own) EXPECT_LE(std::abs(p.y()), kFloorCell_m + 1e-9);
  EXPECT_EQ(seen(scan_of(3.0F), kWall, {}, {kAhead}), own) << "a team-mate's way";
}

TEST(SeenThrough, WhatGivesNoEchoProvesNothing) {
  for (const float range_m : {types::kNoReturn, types::kTooNear, types::kInvalid})
    EXPECT_TRUE(seen(scan_of(range_m), kStander).empty()) << range_m;
}

TEST(SeenThrough, OneBeamThatEndsAtACellKeepsIt) {
  types::Scan scan = scan_of(3.0F);
  scan.range_m[135] = 1.3F;  // straight ahead
  const auto points = seen(scan, kStander);
  EXPECT_FALSE(points.empty());
  for (const Vector2& p : points) EXPECT_GT(std::abs(p.y()), 0.5 * kFloorCell_m);
}

TEST(SeenThrough, AMirroredScannerAndOneWhoseSectorBeginsATurnAwaySeeTheSame) {
  types::Scan scan = scan_of(3.0F);
  scan.range_m[125] = 1.3F;
  const auto points = seen(scan, kStander);
  ASSERT_FALSE(points.empty());
  scan.geometry.angle_min_rad += 6.2831853F;
  EXPECT_EQ(seen(scan, kStander), points);
  scan.geometry.angle_min_rad = 2.3562F;
  scan.geometry.angle_increment_rad = -scan.geometry.angle_increment_rad;
  std::swap(scan.range_m[125], scan.range_m[270 - 125]);
  EXPECT_EQ(seen(scan, kStander), points);
}

TEST(SeenThrough, BehindTheScannerNothingIsSeen) {
  EXPECT_TRUE(seen(scan_of(3.0F), kStander, {}, {}, {0.0, 0.0, 3.1}).empty());
}

TEST(SeenThrough, ALineOverWhichTheRobotWasCarriedIsNoWay) {
  EXPECT_TRUE(seen(scan_of(3.0F), kWall, {stood_at(0.9, 0.0), stood_at(1.75, 0.0)}).empty());
}

/// Wherever the scanner is: what is seen to be free is occupied, near, in view, and nearer than the hits.
TEST(SeenThrough, PointsAreOccupiedCellsBeforeWhatTheScanHits) {
  EXPECT_TRUE(rc::check([] {
    const auto number = [](int low, int high) { return 0.01 * *rc::gen::inRange(low, high); };
    const types::Se2 at{number(-300, 300), number(-300, 300), number(-314, 314)};
    const double range_m = number(50, 600);
    const RouteMapParams params;
    for (const Vector2& p : seen(scan_of(static_cast<float>(range_m)), kStander, kAhead, {}, at)) {
      const Vector2 there = at.inverse() * p;
      RC_ASSERT(kStander.state(kStander.cell_at(p)) == grid::CellState::kOccupied);
      RC_ASSERT(there.norm() <= std::min(range_m - params.live_behind_m, params.live_range_m) + 1e-5);
      RC_ASSERT(std::abs(std::atan2(there.y(), there.x())) <= 2.3563);
    }
  }));
}

}  // namespace
}  // namespace topo::travel
