// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/goal_choice.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/grid/distance.hpp"
#include "tests/unit/core/travel/drawn_map.hpp"

namespace topo::exploration {
namespace {

using travel::drawn_map;

using types::Vector2;

Candidate candidate(double x_m, double cost_m, std::uint16_t place = 0) {
  Candidate c;
  c.goal.p_map = c.goal.opening = Vector2(x_m, 0.0);
  c.goal.place = place;
  c.cost_m = cost_m;
  return c;
}

const types::Stamp kNow = types::stamp_from_seconds(50.0);
constexpr double kRadius_m = 0.33;

TEST(Choose, theCheapestAndNothingOfNothing) {
  const std::vector<Candidate> candidates{candidate(0.0, 5.0), candidate(10.0, 3.0), candidate(20.0, 9.0)};
  EXPECT_EQ(choose(candidates, nullptr, 0.8), &candidates[1]);
  EXPECT_EQ(choose({}, nullptr, 0.8), nullptr);
}

TEST(Choose, thePresentGoalStaysUntilAnotherIsMuchCheaper) {
  const std::vector<Candidate> candidates{candidate(0.0, 5.0), candidate(10.0, 4.5)};
  EXPECT_EQ(choose(candidates, &candidates[0], 0.8), &candidates[0]);
  EXPECT_EQ(choose(candidates, &candidates[0], 1.0), &candidates[1]);
}

/// A room of 3 by 2 m, free but for a wall between its halves.
grid::DenseMap two_rooms() {
  std::vector<std::string> rows(20, std::string(30, '.'));
  for (std::string& row : rows) row[15] = '#';
  return drawn_map(rows, 0.1);
}

TEST(CandidatesOf, sayWhenSomethingIsCutOffAndLeaveOutWhatIsPutOff) {
  const grid::DenseMap map = two_rooms();
  const auto clearance = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
  const grid::TravelField field =
      grid::travel_field(map, clearance, map.cell_at({0.7, 1.0}), grid::TravelRules{});
  goals::Goal here, beyond;
  here.p_map = {0.7, 1.5};
  beyond.p_map = {2.5, 1.0};
  DeferredGoals deferred;
  const types::Se2 robot{0.7, 1.0, 0.0};
  bool cut_off = false;
  const std::vector<ProposedGoal> one{{here, {}}}, both{{here, {}}, {beyond, {}}};
  EXPECT_EQ(candidates_of(one, {map, clearance, field, kRadius_m}, deferred, robot, kNow, {}, cut_off).size(),
            1U);
  EXPECT_FALSE(cut_off);
  EXPECT_EQ(
      candidates_of(both, {map, clearance, field, kRadius_m}, deferred, robot, kNow, {}, cut_off).size(), 1U);
  EXPECT_TRUE(cut_off);
  cut_off = false;
  deferred.give_up(beyond.p_map, kNow + std::chrono::seconds(60), "stuck");
  EXPECT_EQ(
      candidates_of(both, {map, clearance, field, kRadius_m}, deferred, robot, kNow, {}, cut_off).size(), 1U);
  EXPECT_FALSE(cut_off) << "put off is not cut off";
}

TEST(CandidatesOf, aDoorSeenInPartIsLookedThroughFromBeforeIt) {
  grid::DenseMap map = two_rooms();
  for (int y = 6; y < 14; ++y) map.cells[map.index({15, y})] = grid::CellState::kUnknown;
  map.cells[map.index({15, 10})] = grid::CellState::kFree;
  const auto clearance = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
  const grid::TravelField field =
      grid::travel_field(map, clearance, map.cell_at({0.7, 1.0}), grid::TravelRules{.radius_m = kRadius_m});
  goals::Goal beyond;
  beyond.p_map = {2.55, 1.05};
  beyond.side = goals::Side::kEast;
  const auto candidates_now = [&](bool& cut_off) {
    const std::vector<ProposedGoal> goals{{beyond, {}}};
    return candidates_of(goals, {map, clearance, field, kRadius_m}, {}, {0.7, 1.0, 0.0}, kNow, {}, cut_off);
  };
  bool cut_off = false;
  const std::vector<Candidate> looked_at = candidates_now(cut_off);
  ASSERT_EQ(looked_at.size(), 1U);
  EXPECT_FALSE(cut_off);
  EXPECT_LT(looked_at[0].cell.x, 15);
  EXPECT_EQ(looked_at[0].goal.p_map, beyond.p_map);
  beyond.side = goals::Side::kNone;  // a gap: there will be another, in front of the door
  EXPECT_TRUE(candidates_now(cut_off).empty());
  EXPECT_TRUE(cut_off);
}

/// What a robot sees of a large hall is round: the centroid of its frontier is where the robot stands.
TEST(FrontierGoals, aRingOfFrontierLeadsOnThoughItsCentroidIsFarFromIt) {
  grid::DenseMap map = drawn_map(std::vector<std::string>(81, std::string(81, ' ')), 0.1);
  for (int y = 0; y < 81; ++y) {
    for (int x = 0; x < 81; ++x) {
      if (std::hypot(x - 40, y - 40) < 25.0) map.cells[map.index({x, y})] = grid::CellState::kFree;
    }
  }
  const auto clearance_m = grid::clearance_m(map, grid::Boundary::kOccupied);
  const auto field = grid::travel_field(map, clearance_m, {40, 40}, {});
  const auto frontiers = goals::find_frontiers(map);
  ASSERT_EQ(frontiers.size(), 1U);
  const auto found = frontier_goal(map, field, frontiers[0], {});
  ASSERT_TRUE(found);
  EXPECT_TRUE(std::isinf(found->behind_m2)) << found->behind_m2;
}

TEST(SuccessorOf, aGoalThatRecedesIsTheSame) {
  const std::vector<Candidate> candidates{candidate(3.0, 1.0), candidate(9.0, 1.0)};
  goals::Goal goal;
  goal.p_map = goal.opening = Vector2(2.0, 0.0);
  EXPECT_EQ(successor_of(goal, candidates, 2.5), &candidates[0]);
  goal.p_map = goal.opening = Vector2(-5.0, 0.0);
  EXPECT_EQ(successor_of(goal, candidates, 2.5), nullptr);
}

TEST(DeferredGoals, comeBackOnceAndThenStayAway) {
  DeferredGoals deferred;
  const auto later = kNow + std::chrono::seconds(60);
  deferred.give_up({1.0, 1.0}, later, "stuck");
  EXPECT_TRUE(deferred.hold({1.5, 1.0}, kNow));
  EXPECT_FALSE(deferred.hold({3.0, 1.0}, kNow));
  EXPECT_FALSE(deferred.hold({1.0, 1.0}, later));
  EXPECT_TRUE(deferred.call_back(kNow));
  EXPECT_FALSE(deferred.hold({1.0, 1.0}, kNow));
  EXPECT_FALSE(deferred.call_back(kNow));  // it is back already
  deferred.give_up({1.1, 1.0}, later, "stuck again");
  EXPECT_TRUE(deferred.hold({1.0, 1.0}, later + std::chrono::hours(1)));
  EXPECT_FALSE(deferred.call_back(kNow));
}

TEST(DeferredGoals, areToldWhileTheyStayAway) {
  DeferredGoals deferred;
  const auto soon = kNow + std::chrono::seconds(10), later = kNow + std::chrono::seconds(60);
  deferred.give_up({1.0, 1.0}, soon, "stuck");
  deferred.visit({5.0, 1.0}, later);
  EXPECT_EQ(deferred.held(kNow).size(), 2U);
  ASSERT_EQ(deferred.held(soon).size(), 1U) << "the first is back";
  EXPECT_EQ(deferred.held(soon).front().p_map, Vector2(5.0, 1.0));
  EXPECT_FALSE(deferred.held(soon).front().is_for_good());
  deferred.give_up({1.1, 1.0}, later, "stuck again");
  ASSERT_EQ(deferred.held(later).size(), 1U) << "the second is back";
  EXPECT_TRUE(deferred.held(later).front().is_for_good());
  EXPECT_EQ(deferred.held(later).front().why, "stuck again");
}

// Paper section II-E: "Once a robot has visited what seemed to be an attractive location, we do not wish to
// return there."
TEST(DeferredGoals, whereTheRobotWasForTheLastTimeItDoesNotComeAgain) {
  DeferredGoals deferred;
  deferred.visit({5.0, 1.0}, std::nullopt);
  EXPECT_TRUE(deferred.hold({5.5, 1.0}, kNow + std::chrono::hours(1)));
  EXPECT_FALSE(deferred.call_back(kNow)) << "want of anything else is no reason";
  EXPECT_TRUE(deferred.hold({5.5, 1.0}, kNow));
  ASSERT_EQ(deferred.held(kNow).size(), 1U);
  EXPECT_TRUE(deferred.held(kNow).front().is_for_good());
  EXPECT_EQ(deferred.visited(kNow).size(), 1U);
}

TEST(DeferredGoals, ofThoseARobotWasAtTheOthersAreToldWhileTheyStayAway) {
  DeferredGoals deferred;
  const auto later = kNow + std::chrono::seconds(60);
  deferred.give_up({1.0, 1.0}, later, "stuck");
  deferred.visit({5.0, 1.0}, later);
  ASSERT_EQ(deferred.visited(kNow).size(), 1U);
  EXPECT_EQ(deferred.visited(kNow).front(), Vector2(5.0, 1.0));
  EXPECT_TRUE(deferred.hold({5.0, 1.0}, kNow));
  EXPECT_TRUE(deferred.visited(later).empty());
  deferred.visit({1.0, 1.3}, later);  // stuck on the way there, then there: what happened last counts
  EXPECT_EQ(deferred.visited(kNow).size(), 2U);
  EXPECT_EQ(deferred.held(kNow).size(), 2U);
}

}  // namespace
}  // namespace topo::exploration
