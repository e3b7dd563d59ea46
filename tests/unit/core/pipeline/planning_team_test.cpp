// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/pipeline/planning_step.hpp"
#include "tests/unit/core/pipeline/toy_building.hpp"

namespace topo::pipeline {
namespace {

using ::testing::HasSubstr;
using types::Vector2;

/// A corridor with a niche, and a room at either end.
const std::vector<std::string> kTwoRooms = {
    "####################################################",
    "#                 #     ####     #                 #",
    "#                 #     ####     #                 #",
    "#                 #     ####     #                 #",
    "#                 ######    ######                 #",
    "#                                                  #",
    "#                                                  #",
    "#                          S                       #",
    "#                                                  #",
    "#                                                  #",
    "#                 ################                 #",
    "#                 #              #                 #",
    "#                 #              #                 #",
    "####################################################",
};
const Mission kExplore{1, Order::kExplore, false, {0.0, 0.0}};

/// A robot with id 5 that explores, and what its only mate, id 2, says.
class WithAMate : public ::testing::Test {
 protected:
  explicit WithAMate(const PlannerParams& params = {}) : building_(kTwoRooms, 4.0), state_(params) {
    mate_.robot = 2;
    mate_.duty = team::Duty::kAble;
    mate_.T_map_base = {200.0, 0.0, 0.0};  // far away
    input_.robot = 5;
    building_.hear(&input_);
  }

  /// One period; the mate says its message before when it speaks.
  const PlanningOutput& period(bool speaks = true) {
    ++mate_.sequence;
    input_.messages =
        speaks ? std::span<const team::StatusMessage>(&mate_, 1) : std::span<const team::StatusMessage>();
    out_ = building_.run_period(state_, kExplore);
    return out_;
  }

  /// The mate says that it was everywhere the robot could go to: how many of these goals are left?
  std::size_t goals_where_the_mate_was() {
    for (int i = 0; i < 2; ++i) (void)period();
    for (const goals::Goal& goal : out_.report->open_goals) mate_.visited.push_back(goal.p_map);
    EXPECT_GE(mate_.visited.size(), 2U) << "a room at either end";
    for (int i = 0; i < 4; ++i) (void)period();  // a decision holds one and a half seconds
    const auto& open = out_.report->open_goals;
    const auto is_left = [&](const Vector2& p) {
      return std::any_of(open.begin(), open.end(), [&](const auto& goal) { return goal.p_map == p; });
    };
    return static_cast<std::size_t>(std::count_if(mate_.visited.begin(), mate_.visited.end(), is_left));
  }

  ToyBuilding building_;
  PlanningState state_;
  team::StatusMessage mate_;
  TeamInput input_;
  PlanningOutput out_;
};

PlannerParams params_of(exploration::Strategy strategy) {
  PlannerParams params;
  params.explore.strategy = strategy;
  return params;
}

class InTurnWithAMate : public WithAMate {
 protected:
  InTurnWithAMate() : WithAMate(params_of(exploration::Strategy::kGreedyFrontier)) {}
};

class UncoordinatedWithAMate : public WithAMate {
 protected:
  UncoordinatedWithAMate() : WithAMate(params_of(exploration::Strategy::kNearestFrontier)) {}
};

TEST_F(WithAMate, doesNotGoWhereTheMateWas) { EXPECT_EQ(goals_where_the_mate_was(), 0U); }
TEST_F(InTurnWithAMate, doesNotGoWhereTheMateWas) { EXPECT_EQ(goals_where_the_mate_was(), 0U); }
// The baseline without coordination shares the map and nothing else.
TEST_F(UncoordinatedWithAMate, goesWhereTheMateWas) {
  EXPECT_GE(goals_where_the_mate_was(), 2U) << "the room at either end";
}

TEST_F(WithAMate, claimsOneOfItsBids) {
  for (int i = 0; i < 4; ++i) (void)period();
  EXPECT_EQ(out_.message.robot, 5);
  EXPECT_EQ(out_.message.duty, team::Duty::kAble);
  ASSERT_TRUE(out_.message.claim.has_value());
  EXPECT_GE(out_.message.bids.size(), 2U) << "a room at either end";
  EXPECT_TRUE(std::any_of(out_.message.bids.begin(), out_.message.bids.end(),
                          [&](const team::Bid& bid) { return bid.p_map == out_.message.claim->p_map; }));
  EXPECT_FALSE(out_.message.way_map.empty());
}

TEST_F(WithAMate, leavesAGoalToTheNearerRobotAndTakesTheOther) {
  for (int i = 0; i < 2; ++i) (void)period();
  const Vector2 first = out_.message.claim->p_map;
  mate_.claim = team::Bid{first, 0.5};
  mate_.bids = {
      team::Bid{first, 4.0}};  // the way is longer than it was thought: it is no sooner at the other end
  for (int i = 0; i < 2; ++i) (void)period();
  ASSERT_TRUE(out_.message.claim.has_value());
  EXPECT_GT((out_.message.claim->p_map - first).norm(), 3.0) << "the other end of the corridor";

  const auto waits = [&] { return out_.report->reason == "waits: others are nearer to every goal"; };
  for (int i = 0; i < 20 && !waits(); ++i) (void)period();
  ASSERT_TRUE(waits()) << out_.report->reason;
  EXPECT_FALSE(out_.plan.moving);
  EXPECT_FALSE(out_.message.claim.has_value());
  EXPECT_FALSE(out_.message.bids.empty()) << "it would go";

  int silent = 0;
  std::set<std::uint64_t> analysed;
  for (; waits() && silent < 60; ++silent) analysed.insert(period(false).report->analysis->revision);
  EXPECT_LE(analysed.size(), 5U) << "who waits does not look at the map oftener than who goes";
  EXPECT_GE(silent, 18) << "not after the first message that is missing";
  EXPECT_LE(silent, 24) << "ten seconds";
  EXPECT_TRUE(out_.plan.moving);
  ASSERT_TRUE(out_.message.claim.has_value());
  EXPECT_LT((out_.message.claim->p_map - first).norm(), exploration::CandidateParams{}.successor_m)
      << "the goal that was the mate's, which recedes as the map grows";
}

TEST_F(WithAMate, leavesAGoalInThePeriodInWhichAMateIsHeardToHaveIt) {
  for (int i = 0; i < 4; ++i) (void)period();
  for (const int later : {0, 1, 2, 3, 1, 2}) {  // a decision holds three periods
    for (int i = 0; i < later; ++i) (void)period();
    ASSERT_TRUE(out_.message.claim.has_value());
    const Vector2 claimed = out_.message.claim->p_map;
    mate_.claim = team::Bid{claimed + Vector2(1.0, 0.0), 0.2};
    mate_.bids = {{mate_.claim->p_map, 6.0}};
    (void)period();
    ASSERT_TRUE(out_.message.claim.has_value()) << out_.report->reason;
    EXPECT_GT((out_.message.claim->p_map - claimed).norm(), 3.0) << "after " << later << " periods";
  }
}

TEST_F(WithAMate, aMateThatIsLostFreesItsGoal) {
  for (int i = 0; i < 2; ++i) (void)period();
  const Vector2 first = out_.message.claim->p_map;
  mate_.claim = team::Bid{first, 0.5};
  mate_.bids = {*mate_.claim};
  (void)period();
  mate_.duty = team::Duty::kUnable;  // and goes on claiming
  bool taken = false;
  for (int i = 0; i < 60 && !taken; ++i) {
    (void)period();
    taken = out_.message.claim && (out_.message.claim->p_map - first).norm() < 2.5;  // the room behind it
    EXPECT_TRUE(i >= 16 || !taken) << "lost for " << i << " periods only";
  }
  EXPECT_TRUE(taken) << out_.report->reason;
}

TEST_F(WithAMate, whoIsPausedSaysOnWhatItClaims) {
  for (int i = 0; i < 2; ++i) (void)period();
  ASSERT_TRUE(out_.message.claim.has_value());
  const Vector2 claimed = out_.message.claim->p_map;
  Mission paused = kExplore;
  paused.paused = true;
  for (int i = 0; i < 3; ++i) out_ = building_.run_period(state_, paused);
  EXPECT_EQ(out_.message.duty, team::Duty::kUnable) << "the others judge by that, and by for how long";
  ASSERT_TRUE(out_.message.claim.has_value());
  EXPECT_EQ(out_.message.claim->p_map, claimed);
  EXPECT_FALSE(out_.message.bids.empty());
  out_ = building_.run_period(state_, {2, Order::kHome, false, {0.0, 0.0}});
  EXPECT_FALSE(out_.message.claim.has_value()) << "home is no goal that another could want";
}

TEST_F(WithAMate, comesToItsOwnStartWhenTheOperatorSendsItHome) {
  const Vector2 start = building_.robot();
  mate_.start = start - Vector2(1.0, 0.0);
  for (int i = 0; i < 12; ++i) (void)period();
  ASSERT_GT((building_.robot() - start).norm(), 1.0);
  const Mission go_home{2, Order::kHome, false, {0.0, 0.0}};
  for (int i = 0; i < 60 && out_.report->activity != Activity::kDone; ++i) {
    ++mate_.sequence;
    input_.messages = {&mate_, 1};
    out_ = building_.run_period(state_, go_home);
  }
  EXPECT_TRUE(out_.report->mission_ended) << "whoever is out: " << out_.report->reason;
  EXPECT_LT((building_.robot() - start).norm(), 0.3);
}

TEST_F(WithAMate, comesHomeOnALowBatteryToOnePlace) {
  const Vector2 start = building_.robot();
  mate_.start = start + Vector2(1.5, 0.0);
  for (int i = 0; i < 30 && (building_.robot() - mate_.start).norm() < 4.0; ++i) (void)period();
  ASSERT_GT((building_.robot() - mate_.start).norm(), 4.0);
  building_.control().battery_v = 11.2F;
  for (int i = 0; i < 60 && out_.report->activity != Activity::kReturning; ++i) (void)period();
  ASSERT_EQ(out_.report->reason, "the battery is low");
  const std::uint64_t goal_id = out_.plan.goal_id;
  for (int i = 0; i < 5; ++i) EXPECT_EQ(period().plan.goal_id, goal_id) << "control begins anew with each";
  for (int i = 0; i < 100 && out_.message.duty != team::Duty::kOver; ++i) (void)period();
  EXPECT_LT((building_.robot() - mate_.start).norm(), 0.5) << "the nearer of the two";
}

TEST_F(WithAMate, goesHomeWithNothingToGainAndWaitsThere) {
  mate_.bids = {{{200.0, 1.0}, 3.0}};  // in a part of the building that this robot cannot see
  mate_.claim = mate_.bids.front();
  const Vector2 start = building_.robot();
  int periods = 0;
  do {
    mate_.T_map_base.x_m += 0.3;  // it gets on
    (void)period();
  } while (out_.report->reason != "home, waits for the others" && ++periods < 700);
  EXPECT_GE(building_.coverage(), 0.97);
  EXPECT_LT((building_.robot() - start).norm(), 0.5) << out_.report->reason;
  mate_.bids.clear();
  mate_.claim.reset();
  for (int i = 0; i < 200 && out_.message.duty != team::Duty::kOver; ++i) (void)period();
  EXPECT_EQ(out_.message.duty, team::Duty::kOver) << out_.report->reason;
  EXPECT_LT((building_.robot() - start).norm(), 0.3);
  EXPECT_FALSE(out_.report->mission_ended) << "the mate is still out";
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(period().plan.moving);
  mate_.duty = team::Duty::kOver;
  for (int i = 0; i < 3; ++i) (void)period();
  EXPECT_TRUE(out_.report->mission_ended);
  EXPECT_EQ(out_.report->activity, Activity::kDone) << out_.report->reason;
}

/// A robot that goes back after 8 s without a message.
class OutOfContact : public WithAMate {
 protected:
  static PlannerParams params() {
    PlannerParams params;
    params.contact_lost_s = 8.0;
    return params;
  }
  const PlanningOutput& explore(bool mate_speaks) {
    ++mate_.sequence;
    input_.messages = mate_speaks ? std::span<const team::StatusMessage>(&mate_, 1)
                                  : std::span<const team::StatusMessage>();
    out_ = building_.run_period(impatient_, kExplore);
    return out_;
  }
  [[nodiscard]] bool goes_back() const {
    return out_.report->reason == "goes back to where another was last heard";
  }
  /// Until it goes back, at most 20 s.
  void lose_contact() {
    for (int i = 0; i < 40 && !goes_back(); ++i) (void)explore(false);
  }
  PlanningState impatient_{params()};
};

TEST_F(OutOfContact, goesBackToWhereItLastHeardOfAMateThenOn) {
  for (int i = 0; i < 6; ++i) (void)explore(true);
  const Vector2 heard_at = building_.robot();
  lose_contact();
  ASSERT_TRUE(goes_back()) << out_.report->reason;
  EXPECT_GT((building_.robot() - heard_at).norm(), 2.0);
  EXPECT_FALSE(out_.message.claim.has_value()) << "that place is no goal that another could want";
  for (int i = 0; i < 60 && goes_back(); ++i) (void)explore(false);
  EXPECT_LT((building_.robot() - heard_at).norm(), 1.4) << "half a metre, and a plan further";
  EXPECT_EQ(out_.report->activity, Activity::kExploring) << out_.report->reason;
  EXPECT_TRUE(out_.message.claim.has_value());
  for (int i = 0; i < 14; ++i) EXPECT_FALSE((explore(false), goes_back())) << "in vain is not again soon";
}

TEST_F(OutOfContact, goesOnAsSoonAsItHearsOfOne) {
  for (int i = 0; i < 6; ++i) (void)explore(true);
  lose_contact();
  ASSERT_TRUE(goes_back()) << out_.report->reason;
  for (int i = 0; i < 2; ++i) (void)explore(true);
  EXPECT_FALSE(goes_back());
  EXPECT_TRUE(out_.message.claim.has_value()) << out_.report->reason;
}

TEST_F(OutOfContact, nobodyLooksForWhoIsHome) {
  for (int i = 0; i < 6; ++i) (void)explore(true);
  mate_.duty = team::Duty::kOver;
  (void)explore(true);
  lose_contact();
  EXPECT_FALSE(goes_back());
}

TEST_F(WithAMate, makesRoomForOneWhoseWayLeadsThroughIt) {
  for (int i = 0; i < 3; ++i) (void)period();
  ASSERT_TRUE(out_.message.claim.has_value());
  const Vector2 bound_to = out_.message.claim->p_map;
  // Head on, in the middle of the corridor, from where the robot is bound to.
  const Vector2 here = building_.robot();
  const Vector2 there = out_.message.way_map[std::min<std::size_t>(6, out_.message.way_map.size() - 1)];
  mate_.T_map_base = {there.x(), there.y(), 0.0};
  mate_.way_map.clear();
  for (int i = 0; i <= 20; ++i) mate_.way_map.push_back(there + (here - there) * (i / 10.0));
  (void)period();
  EXPECT_THAT(out_.report->reason, HasSubstr("makes room for robot 2"));
  for (int i = 0; i < 20; ++i) (void)period();
  const Vector2 aside = building_.robot();
  for (const Vector2& p : mate_.way_map) EXPECT_GT((p - aside).norm(), 0.85);
  // The mate has passed, and goes on to the west.
  mate_.claim = team::Bid{{1.5, 1.7}, 0.5};
  mate_.bids = {*mate_.claim};
  mate_.T_map_base = {200.0, 0.0, 0.0};
  mate_.way_map.clear();
  for (int i = 0; i < 4; ++i) (void)period();
  EXPECT_EQ(out_.report->activity, Activity::kExploring) << out_.report->reason;
  EXPECT_TRUE(out_.plan.moving);
  EXPECT_TRUE(out_.message.visited.empty()) << "being in the room is not being at the goal";
  ASSERT_GT(bound_to.x(), aside.x());
  const auto is_there = [&] { return (building_.robot() - bound_to).norm() < 1.0; };
  for (int i = 0; i < 40 && !is_there(); ++i) {
    ASSERT_TRUE(out_.message.claim.has_value()) << out_.report->reason;
    EXPECT_GT(out_.message.claim->p_map.x(), aside.x()) << "on the way there, not where the mate goes";
    (void)period();
  }
  EXPECT_TRUE(is_there());
}

TEST_F(WithAMate, doesNotBackOffIntoAMateNorPassOneAtFullSpeed) {
  for (int i = 0; i < 3; ++i) (void)period();
  ASSERT_TRUE(out_.plan.moving);
  EXPECT_FALSE(out_.plan.mate_behind);
  EXPECT_TRUE(std::isinf(out_.plan.v_max_mps));
  const auto mate_at = [&](double ahead_m) {
    const Vector2 at = out_.report->T_map_base.se2() * Vector2(ahead_m, 0.0);
    mate_.T_map_base = {at.x(), at.y(), 0.0};
    mate_.way_map = {at, at + Vector2(0.1, 0.0)};
    (void)period();
  };
  mate_at(-1.2);
  EXPECT_TRUE(out_.plan.mate_behind);
  mate_at(1.9);
  EXPECT_FALSE(out_.plan.mate_behind);
  EXPECT_TRUE(!out_.plan.moving || out_.plan.v_max_mps <= 0.25);
  mate_.way_map.clear();
  mate_at(-5.0);
  EXPECT_FALSE(out_.plan.mate_behind);
}

TEST_F(WithAMate, aMateThatStandsForGoodIsAnObstacle) {
  mate_.T_map_base = {7.0, 2.5, 0.0};
  (void)period();
  const auto touches_of_the_mate = [&] {
    ++building_.control().touches;
    building_.control().touched_odom = {7.0, 2.5};
    const auto& decisions = period().report->decisions;
    return std::count_if(decisions.begin(), decisions.end(),
                         [](const Decision& d) { return d.text == "touched something here"; });
  };
  EXPECT_EQ(touches_of_the_mate(), 0) << "it will go on";
  mate_.duty = team::Duty::kUnable;
  EXPECT_EQ(touches_of_the_mate(), 1);
  mate_.duty = team::Duty::kOver;
  EXPECT_EQ(touches_of_the_mate(), 2);
}

/// A corridor with one way on, in its middle; robots start at its ends.
std::vector<std::string> side_way(std::size_t start_column) {
  std::vector<std::string> rows(12, "###############      ###############");
  rows.insert(rows.end(), 6, "#                                  #");
  rows.insert(rows.end(), 1, "####################################");
  rows.insert(rows.begin(), 1, "####################################");
  rows[16][start_column] = 'S';
  return rows;
}

TEST(TwoRobots, aPeriodLateNotBothKeepTheOnlyGoal) {
  std::array<ToyBuilding, 2> building{ToyBuilding(side_way(3)), ToyBuilding(side_way(32))};
  std::array<PlanningState, 2> state{PlanningState(PlannerParams{}), PlanningState(PlannerParams{})};
  std::array<std::vector<team::StatusMessage>, 2> said;
  for (int i = 0; i < 9; ++i) {
    std::array<std::vector<team::StatusMessage>, 2> says;
    for (std::size_t r = 0; r < 2; ++r) {
      const TeamInput input{static_cast<std::uint16_t>(r), said[1 - r]};
      building[r].hear(&input);
      const PlanningOutput out = building[r].run_period(state[r], kExplore);
      building[r].hear(nullptr);
      says[r] = {out.message};
    }
    said = says;
    if (i < 4) continue;
    EXPECT_NE(said[0][0].claim.has_value(), said[1][0].claim.has_value()) << "after " << i << " periods";
  }
}

TEST_F(WithAMate, aRobotAloneIsATeamOfOne) {
  building_.hear(nullptr);
  const team::StatusMessage message = period().message;
  EXPECT_EQ(message.duty, team::Duty::kAble);
  EXPECT_FALSE(message.home.has_value());
}

}  // namespace
}  // namespace topo::pipeline
