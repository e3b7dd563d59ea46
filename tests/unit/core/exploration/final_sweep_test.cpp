// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/exploration/final_sweep.hpp"

#include <gtest/gtest.h>

#include "tests/unit/core/grid/maps.hpp"

namespace topo::exploration {
namespace {

using grid::CellState;

/// A room of 4 m by 3 m, all of it known, two gaps of 0.4 m in its right wall, and of what is behind them two
/// walls.
class TwoGaps : public ::testing::Test {
 protected:
  static constexpr int kWallX = 80;
  TwoGaps() : map(grid::filled_map(160, 60, CellState::kUnknown)) {
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 160; ++x) {
        if (x > kWallX && y != 0 && y != 59) continue;
        const bool gap = x == kWallX && (y / 8 == 1 || y / 8 == 5);
        const bool wall = x == 0 || y == 0 || y == 59 || x == kWallX;
        map.cells[map.index({x, y})] = wall && !gap ? CellState::kOccupied : CellState::kFree;
      }
    }
    field = field_from(map, {40, 30});
    looks.begin(at(0.0));
  }
  void find(std::uint64_t revision) { looks.find({map, revision, 12.0, field, {}, 1.2}, now, {}); }
  static types::Stamp at(double t_s) { return types::stamp_from_seconds(1000.0 + t_s); }

  static FinalSweepParams params() {
    FinalSweepParams params;
    params.promise_min = 0.02;
    params.time_share = 0.75;
    return params;
  }

  types::Stamp now = at(100.0);
  grid::DenseMap map;
  grid::TravelField field;
  FinalSweep looks{params()};
};

TEST_F(TwoGaps, AreTwoGoals) {
  find(1);
  ASSERT_EQ(looks.goals().size(), 2U);
  for (const goals::Goal& goal : looks.goals()) {
    EXPECT_NEAR(goal.opening.x(), 0.05 * (kWallX + 0.5), 1e-9);
    EXPECT_NEAR(goal.opening_m, 0.4, 1e-9);
    EXPECT_GT(goal.behind_m2, 0.3);
    EXPECT_TRUE(std::isfinite(field.cost_m[map.index(map.cell_at(goal.p_map))]));
  }
}

TEST_F(TwoGaps, AreNotWorthTheWayWhenTheyPromiseLittleOfWhatIsKnown) {
  looks.find({map, 1, 1e4, field, {}, 1.2}, now, {});
  EXPECT_TRUE(looks.empty());
  find(2);
  EXPECT_FALSE(looks.empty()) << "what was not worth it was not offered";
}

TEST_F(TwoGaps, AreNotLookedIntoFromWhereNoWayLeadsAnyMore) {
  looks.find({map, 1, 1e4, field, {}, 1.2}, now, {});
  const grid::TravelField nowhere = field_from(map, {500, 500});
  looks.find({map, 2, 12.0, nowhere, {}, 1.2}, now, {});
  EXPECT_TRUE(looks.empty()) << "though a second ago there was a way";
  find(3);
  EXPECT_EQ(looks.goals().size(), 2U);
}

TEST_F(TwoGaps, AreOfferedOnce) {
  find(1);
  looks.leave(looks.numbers().front());
  EXPECT_EQ(looks.goals().size(), 1U);
  find(2);
  EXPECT_EQ(looks.goals().size(), 1U) << "as long as one is left nothing is looked for";
  looks.leave(looks.numbers().front());
  find(3);
  EXPECT_TRUE(looks.empty());
  looks.begin(now);
  find(3);
  EXPECT_EQ(looks.goals().size(), 2U);
}

TEST_F(TwoGaps, OfWhichAMateHasLookedIntoOneLeaveTheOther) {
  find(1);
  const std::vector<types::Vector2> looked{looks.goals().front().opening + types::Vector2(0.1, 0.0)};
  looks.share(looked);
  ASSERT_EQ(looks.goals().size(), 1U);
  EXPECT_GT((looks.goals().front().opening - looked.front()).norm(), 0.5);
  EXPECT_TRUE(looks.looked().empty()) << "what a mate saw is the mate's to tell";
}

TEST_F(TwoGaps, AreNotFoundWhenAMateHasLookedIntoThem) {
  find(1);
  std::vector<types::Vector2> looked;
  for (const goals::Goal& goal : looks.goals()) looked.push_back(goal.opening);
  looks.begin(now);
  looks.share(looked);
  find(2);
  EXPECT_TRUE(looks.empty());
}

TEST_F(TwoGaps, OnlyVisitedOpeningsAreToldToMates) {
  find(1);
  const goals::Goal first = looks.goals().front();
  EXPECT_FALSE(looks.arrive(0));
  EXPECT_TRUE(looks.arrive(looks.numbers().front()));
  EXPECT_TRUE(looks.leave(looks.numbers().front()));
  EXPECT_EQ(looks.looked(), std::vector{first.opening});
}

TEST_F(TwoGaps, AreSettledWhenTheirSightIsKnown) {
  find(1);
  for (int y = 1; y < 59; ++y)
    for (int x = kWallX + 1; x < 159; ++x) map.cells[map.index({x, y})] = CellState::kFree;
  looks.settle(map, now);
  EXPECT_TRUE(looks.empty());
}

TEST_F(TwoGaps, SweepsEndAfterTheirShareOfTheTime) {
  find(1);
  looks.settle(map, at(174.0));
  EXPECT_EQ(looks.goals().size(), 2U);
  looks.leave(looks.numbers().front());
  looks.settle(map, at(176.0));
  EXPECT_TRUE(looks.empty());
  now = at(177.0);
  find(2);
  EXPECT_TRUE(looks.empty());
  looks.begin(at(200.0));
  now = at(300.0);
  find(2);
  EXPECT_EQ(looks.goals().size(), 2U);
}

TEST_F(TwoGaps, SweptBeforeAnotherGoalCameCountsLikeOneSweep) {
  find(1);
  looks.interrupt(at(150.0));
  now = at(300.0);
  find(2);
  ASSERT_EQ(looks.goals().size(), 2U) << "those left";
  // 250 s without sweeps allow 187.5 s of them, of which 50 s are over.
  looks.settle(map, at(437.0));
  EXPECT_EQ(looks.goals().size(), 2U);
  looks.settle(map, at(438.0));
  EXPECT_TRUE(looks.empty());
}

TEST_F(TwoGaps, MoveWithTheMap) {
  find(1);
  const std::vector<goals::Goal> before = looks.goals();
  std::vector<types::KeyframePose> keyframes{{now, {0.0, 0.0, 0.0}}};
  types::MapAnchors anchors;
  (void)anchors.take(keyframes, 0.1, 0.03);
  keyframes[0].T_map_base = {0.0, 30.0, 0.0};
  looks.move(*anchors.take(keyframes, 0.1, 0.03));
  const std::vector<goals::Goal> after = looks.goals();
  ASSERT_EQ(after.size(), before.size());
  const Vector2 by(0.0, 30.0);
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_LT((after[i].p_map - before[i].p_map - by).norm(), 1e-9);
    EXPECT_LT((after[i].opening - before[i].opening - by).norm(), 1e-9);
  }
  looks.share(std::vector<Vector2>{after.front().opening});
  EXPECT_EQ(looks.goals().size(), 1U);
}

TEST_F(TwoGaps, TimeInWhichTheRobotMayNotGoOnCountsForNothing) {
  find(1);
  looks.wait(std::chrono::seconds(1000));
  looks.settle(map, at(1174.0));
  EXPECT_EQ(looks.goals().size(), 2U);
  looks.settle(map, at(1176.0));
  EXPECT_TRUE(looks.empty()) << "nor does it make the sweep longer";
}

TEST_F(TwoGaps, AtOnceAfterTheBeginningAreLookedInto) {
  looks.begin(now);
  find(1);
  looks.settle(map, now + std::chrono::seconds(59));
  EXPECT_EQ(looks.goals().size(), 2U);
  looks.settle(map, now + std::chrono::seconds(61));
  EXPECT_TRUE(looks.empty());
}

TEST_F(TwoGaps, AreToldFromOtherGoals) {
  find(1);
  EXPECT_FALSE(looks.leave(0));
  EXPECT_TRUE(looks.leave(looks.numbers().front()));
}

TEST_F(TwoGaps, AreNotAskedForTooOften) {
  looks.find({map, 1, 1e4, field, {}, 1.2}, at(10.0), std::chrono::seconds(30));
  looks.find({map, 2, 12.0, field, {}, 1.2}, at(39.0), std::chrono::seconds(30));
  EXPECT_TRUE(looks.empty());
  looks.find({map, 3, 12.0, field, {}, 1.2}, at(41.0), std::chrono::seconds(30));
  EXPECT_FALSE(looks.empty());
}

}  // namespace
}  // namespace topo::exploration
