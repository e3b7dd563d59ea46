// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/travel/closed_way.hpp"

#include <gtest/gtest.h>

#include "core/grid/distance.hpp"
#include "tests/unit/core/travel/drawn_map.hpp"

namespace topo::travel {
namespace {

constexpr double kAway_m = 1.0;

/// A corridor of 8 by 2 m, with obstacles across it at these columns, through which a robot drove from the
/// left to the right.
struct Corridor {
  explicit Corridor(const std::vector<std::size_t>& closed_at) {
    std::vector<std::string> rows(22, std::string(82, '#'));
    for (std::size_t y = 1; y < 21; ++y) {
      rows[y].replace(1, 80, 80, '.');
      for (const std::size_t x : closed_at) rows[y][x] = '#';
    }
    map = drawn_map(rows, 0.1);
    clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
    for (double x = 0.85; x < 7.5; x += 0.4) way.emplace_back(x, 1.05);
  }
  [[nodiscard]] std::optional<ClosedWay> seen_from(int column) const {
    return closed_way(map, grid::travel_field(map, clearance_m, {column, 10}, {}), way, kAway_m);
  }
  grid::DenseMap map;
  std::vector<float> clearance_m;
  std::vector<types::Vector2> way;
};

TEST(ClosedWay, AnOpenWayHasNone) { EXPECT_FALSE(Corridor({}).seen_from(70)); }

TEST(ClosedWay, WhatClosesItIsLookedAtFromAMetreAway) {
  const auto closed = Corridor({40}).seen_from(70);
  ASSERT_TRUE(closed);
  EXPECT_NEAR(closed->closed_at.x(), 4.05, 0.41);
  EXPECT_GE(closed->look_from.x() - closed->closed_at.x(), kAway_m);
  EXPECT_LT(closed->look_from.x() - closed->closed_at.x(), kAway_m + 0.41);
}

TEST(ClosedWay, OfTwoObstaclesTheOneInReachIsLookedAt) {
  const auto closed = Corridor({20, 50}).seen_from(70);
  ASSERT_TRUE(closed);
  EXPECT_NEAR(closed->closed_at.x(), 5.05, 0.41);
}

TEST(ClosedWay, AShortWayIsLookedAtFromItsEnd) {
  const auto closed = Corridor({65}).seen_from(76);
  ASSERT_TRUE(closed);
  EXPECT_GT(closed->look_from.x(), 6.55);
  EXPECT_LT(closed->look_from.x() - closed->closed_at.x(), kAway_m);
}

TEST(ClosedWay, ABeginningInReachIsNotClosed) { EXPECT_FALSE(Corridor({40}).seen_from(10)); }

TEST(ClosedWay, AWayOutOfReachAndNoWayHaveNone) {
  Corridor corridor({40});
  corridor.way.resize(3);
  EXPECT_FALSE(corridor.seen_from(70)) << "the robot was carried";
  corridor.way.clear();
  EXPECT_FALSE(corridor.seen_from(70));
}

TEST(ClosedWay, AWayBeginsWhereTheRobotWasSetDown) {
  std::vector<types::KeyframePose> way;
  for (const double x : {0.0, 0.4, 5.0, 5.4})
    way.push_back({types::Stamp{}, types::Transform2<types::Map, types::Base>(x, 1.0, 0.0)});
  const auto positions = positions_of(way, 0.8);
  ASSERT_EQ(positions.size(), 2U);
  EXPECT_EQ(positions.front(), types::Vector2(5.0, 1.0));
  EXPECT_EQ(positions_of(way, 10.0).size(), 4U);
}

}  // namespace
}  // namespace topo::travel
