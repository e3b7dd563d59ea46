// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/threads/area_log.hpp"

#include <gtest/gtest.h>

#include "tests/unit/core/team/exchange/exchange_fixture.hpp"

namespace topo::daemon {
namespace {

const types::Polygon kStairs{{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}};

/// A robot's exchange and what stands between it and main.
struct Side {
  explicit Side(std::uint16_t number, std::uint32_t run = 1) : robot(number, run) {}
  /// What the log says of areas after what came.
  TeamAreas areas() {
    log.note(robot.exchange.take_news(team::testing::at(now_s)).entries);
    (void)log.settle(robot.exchange);
    return log.report();
  }
  team::testing::Robot robot;
  AreaLog log;
  double now_s = 0.0;
};

void talk(Side& a, Side& b) {
  team::testing::talk(a.robot, b.robot, a.now_s, a.now_s + 5.0);
  a.now_s = b.now_s = a.now_s + 5.0;
}

TEST(AreaLog, BringsAnAreaIntoAMatesMap) {
  Side a(1), b(2);
  a.log.want({{{1, kStairs}}, {}});
  EXPECT_TRUE(a.areas().of_mates.empty()) << "own ones are main's";
  talk(a, b);
  ASSERT_EQ(b.areas().of_mates.size(), 1U);
  EXPECT_FALSE(b.areas().of_mates.front().corners_map.has_value()) << "where is that map?";
  b.log.place({1, 1}, {10.0, 0.0, M_PI / 2.0});
  const TeamAreas there = b.areas();
  ASSERT_TRUE(there.of_mates.front().corners_map.has_value());
  const types::Polygon& corners = *there.of_mates.front().corners_map;
  EXPECT_NEAR((corners[1] - types::Vector2(10.0, 2.0)).norm(), 0.0, 1e-9);
}

// A map that is corrected takes its areas along, and what mates have of them too.
TEST(AreaLog, AnAreaThatMovedWithItsMapMovesInAMates) {
  Side a(1), b(2);
  a.log.want({{{1, kStairs}}, {}});
  (void)a.areas();
  talk(a, b);
  b.log.place({1, 1}, {10.0, 0.0, 0.0});
  ASSERT_EQ(b.areas().of_mates.size(), 1U);
  const team::EntryId before = b.areas().of_mates.front().id;

  types::Polygon moved = kStairs;
  for (types::Vector2& corner : moved) corner += types::Vector2(0.3, -0.2);
  a.log.want({{{1, moved}}, {}});
  EXPECT_TRUE(a.areas().own_withdrawn.empty()) << "its owner has it still";
  talk(a, b);
  const TeamAreas there = b.areas();
  ASSERT_EQ(there.of_mates.size(), 1U);
  EXPECT_NEAR((there.of_mates.front().corners_map->front() - types::Vector2(10.3, -0.2)).norm(), 0.0, 1e-9);
  EXPECT_EQ(there.of_mates.front().id, before) << "an operator has read its id";
  EXPECT_TRUE(there.withdrawn.empty());

  const std::size_t said = team::log_of(a.robot.exchange.items()).size();
  for (types::Vector2& corner : moved) corner.x() += 0.01;
  a.log.want({{{1, moved}}, {}});
  (void)a.areas();
  EXPECT_EQ(team::log_of(a.robot.exchange.items()).size(), said) << "a centimetre is nothing to say";
}

// The withdrawal and the correction cross: what an operator withdrew stays withdrawn.
TEST(AreaLog, AWithdrawnAreaDoesNotComeBackWhenItsMapMoves) {
  Side a(1), b(2);
  a.log.want({{{1, kStairs}}, {}});
  (void)a.areas();
  talk(a, b);
  const team::EntryId id = b.areas().of_mates.front().id;
  b.log.want({{}, {id}});
  EXPECT_TRUE(b.areas().of_mates.empty());
  types::Polygon moved = kStairs;
  for (types::Vector2& corner : moved) corner.x() += 1.0;
  a.log.want({{{1, moved}}, {}});
  EXPECT_TRUE(a.areas().own_withdrawn.empty()) << "it has not heard yet";
  talk(a, b);
  EXPECT_EQ(a.areas().own_withdrawn, std::vector<std::uint64_t>{1});
  EXPECT_TRUE(b.areas().of_mates.empty());
}

TEST(AreaLog, AnAreaKeepsItsKind) {
  Side a(1), b(2);
  a.log.want({{{1, kStairs, types::AreaKind::kHereFirst}, {2, kStairs}}, {}});
  (void)a.areas();
  talk(a, b);
  const TeamAreas there = b.areas();
  ASSERT_EQ(there.of_mates.size(), 2U);
  EXPECT_EQ(there.of_mates[0].kind, types::AreaKind::kHereFirst);
  EXPECT_EQ(there.of_mates[1].kind, types::AreaKind::kKeepOut);
}

TEST(AreaLog, AFrameThatHardlyMovesMovesNoArea) {
  Side a(1), b(2);
  a.log.want({{{1, kStairs}}, {}});
  (void)a.areas();
  talk(a, b);
  b.log.place({1, 1}, {10.0, 0.0, 0.0});
  const auto x_m = [&] { return b.areas().of_mates.front().corners_map->front().x(); };
  EXPECT_EQ(x_m(), 10.0);
  b.log.place({1, 1}, {10.01, 0.0, 0.0});
  EXPECT_EQ(x_m(), 10.0);
  b.log.place({1, 1}, {10.05, 0.0, 0.0});
  EXPECT_EQ(x_m(), 10.05);
}

TEST(AreaLog, TheOwnerAndAMateWithdraw) {
  Side a(1), b(2);
  a.log.want({{{1, kStairs}, {2, kStairs}}, {}});
  (void)a.areas();
  talk(a, b);
  const TeamAreas there = b.areas();
  ASSERT_EQ(there.of_mates.size(), 2U);
  b.log.want({{}, {there.of_mates[0].id}});
  EXPECT_EQ(b.areas().of_mates.size(), 1U);
  talk(a, b);
  EXPECT_EQ(a.areas().own_withdrawn, std::vector<std::uint64_t>{1});
  a.log.want({{}, {}});
  (void)a.areas();
  talk(a, b);
  EXPECT_TRUE(b.areas().of_mates.empty());
  EXPECT_EQ(b.areas().withdrawn.size(), 2U);
}

TEST(AreaLog, ARestartedRobotsAreasAreThereOnce) {
  Side a(1), b(2), again(1, 2);
  a.log.want({{{1, kStairs}}, {}});
  (void)a.areas();
  talk(a, b);
  again.now_s = b.now_s;
  again.log.want({{{1, kStairs}}, {}});
  (void)again.areas();
  for (int i = 0; i < 6; ++i) {
    talk(again, b);
    (void)again.areas();
  }
  const TeamAreas there = b.areas();
  ASSERT_EQ(there.of_mates.size(), 1U);
  EXPECT_EQ(there.of_mates.front().id.run, 2U);
}

// Between the restart and the moment in which the new map has a place here, the old entry holds.
TEST(AreaLog, ARestartedRobotsAreasAreNeverMissing) {
  Side a(1), b(2), again(1, 2);
  a.log.want({{{1, kStairs}}, {}});
  (void)a.areas();
  talk(a, b);
  b.log.place({1, 1}, {10.0, 0.0, 0.0});
  ASSERT_EQ(b.areas().of_mates.front().corners_map->front().x(), 10.0);
  again.now_s = b.now_s;
  types::Polygon kept = kStairs;  // a file of areas may have moved by less than is told
  for (types::Vector2& corner : kept) corner.x() += 0.01;
  again.log.want({{{1, kept}}, {}});
  (void)again.areas();
  const auto placed = [&] {
    std::vector<double> x_m;
    for (const TeamAreas::OfMate& area : b.areas().of_mates)
      if (area.corners_map) x_m.push_back(area.corners_map->front().x());
    return x_m;
  };
  for (int i = 0; i < 6; ++i) {
    talk(again, b);
    (void)again.areas();
    EXPECT_EQ(placed(), std::vector<double>{10.0}) << i;
    EXPECT_TRUE(b.areas().withdrawn.empty());
  }
  b.log.place({1, 2}, {20.0, 0.0, 0.0});
  ASSERT_EQ(placed().size(), 1U);
  EXPECT_NEAR(placed().front(), 20.01, 1e-9);
  EXPECT_EQ(b.areas().withdrawn, (std::vector<team::EntryId>{{1, 0, 1}}));
}

// An operator withdraws what an earlier run of this robot drew: that is said once, however often it is
// wished.
TEST(AreaLog, WithdrawsAnAreaOfAnEarlierRunOnce) {
  Side a(1), b(2), again(1, 2);
  a.log.want({{{1, kStairs}}, {}});
  (void)a.areas();
  talk(a, b);
  again.now_s = b.now_s;
  talk(again, b);
  again.log.want({{}, {{1, 0, 1}}});
  EXPECT_EQ(again.areas().withdrawn, (std::vector<team::EntryId>{{1, 0, 1}}));
  const std::size_t said = team::log_of(again.robot.exchange.items()).size();
  again.log.want({{}, {{1, 0, 1}}});
  (void)again.areas();
  EXPECT_EQ(team::log_of(again.robot.exchange.items()).size(), said);
}

TEST(AreaLog, ANewMapsRunHasThemAnew) {
  Side a(1);
  a.log.want({{{1, kStairs}}, {}});
  (void)a.areas();
  EXPECT_EQ(team::areas_of(team::log_of(a.robot.exchange.items())).areas.size(), 1U);
  team::testing::Robot later(1, 2);
  a.log.begin_map();
  EXPECT_TRUE(a.log.settle(later.exchange));
  EXPECT_EQ(team::areas_of(team::log_of(later.exchange.items())).areas.size(), 1U);
  EXPECT_FALSE(a.log.settle(later.exchange)) << "nothing has changed";
}

}  // namespace
}  // namespace topo::daemon
