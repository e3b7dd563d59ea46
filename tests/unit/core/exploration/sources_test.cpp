// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/sources.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/exploration/choice.hpp"
#include "core/exploration/travel_table.hpp"
#include "tests/unit/core/exploration/toy_decision.hpp"

namespace topo::exploration {
namespace {

/// One decision's sources after the first look around.
class Sources : public ToyDecision {
 protected:
  [[nodiscard]] Choice chosen(const std::vector<Candidate>& candidates) {
    const TravelTable table = travel_table(candidates, nullptr, here(), searches(), params_.tour);
    return choose({candidates, table, nullptr, 0.0}, situation(), map_, params_);
  }
};

TEST_F(Sources, EssentialGoalsLieAtEitherEnd) {
  const Reachable found = essential_candidates(situation(), map_, deferred_, params_, false);
  ASSERT_GE(found.candidates.size(), 2U);
  for (const Candidate& c : found.candidates) EXPECT_EQ(c.id.source, Source::kEssential);
  const auto [west, east] =
      std::ranges::minmax(found.candidates, {}, [](const Candidate& c) { return c.goal.p_map.x(); });
  EXPECT_LT(west.goal.p_map.x(), building_.robot().x());
  EXPECT_GT(east.goal.p_map.x(), building_.robot().x());
}

TEST_F(Sources, ADeferredGoalIsNoCandidate) {
  const Reachable all = essential_candidates(situation(), map_, deferred_, params_, false);
  const types::Vector2 first = all.candidates.front().goal.p_map;
  deferred_.give_up(first, building_.now() + std::chrono::seconds(60), "stuck");
  const Reachable left = essential_candidates(situation(), map_, deferred_, params_, false);
  EXPECT_LT(left.candidates.size(), all.candidates.size());
  for (const Candidate& c : left.candidates)
    EXPECT_GT((c.goal.p_map - first).norm(), params_.deferral.same_m);
}

TEST_F(Sources, AGoalThatATeamMateVisitedIsNoCandidate) {
  const Reachable all = essential_candidates(situation(), map_, deferred_, params_, false);
  team::StatusMessage mate;
  mate.robot = 7;
  mate.T_map_base = {500.0, 0.0, 0.0};
  mate.visited = {all.candidates.front().goal.p_map};
  hear(mate);
  EXPECT_LT(essential_candidates(situation(), map_, deferred_, params_, false).candidates.size(),
            all.candidates.size());
  ExplorationParams alone = params_;
  alone.strategy = Strategy::kNearestFrontier;
  EXPECT_EQ(essential_candidates(situation(), map_, deferred_, alone, false).candidates.size(),
            all.candidates.size())
      << "without coordination robots share the map alone";
}

TEST_F(Sources, GapsBesideAnEssentialGoalAreThatGoal) {
  const Reachable essential = essential_candidates(situation(), map_, deferred_, params_, false);
  const std::vector<goals::Frontier> all = frontiers();
  const Reachable gaps = gap_candidates(all, {}, situation(), map_, deferred_, params_);
  ASSERT_FALSE(gaps.candidates.empty());
  for (const Candidate& c : gaps.candidates) EXPECT_EQ(c.id.source, Source::kGap);
  EXPECT_LT(
      gap_candidates(all, essential.candidates, situation(), map_, deferred_, params_).candidates.size(),
      gaps.candidates.size());
}

TEST_F(Sources, EveryFrontierIsACandidateOfAFrontierStrategy) {
  const Reachable found = frontier_candidates(frontiers(), situation(), map_, deferred_, params_);
  EXPECT_EQ(found.candidates.size(), frontiers().size());
  for (const Candidate& c : found.candidates) EXPECT_EQ(c.id.source, Source::kFrontier);
}

TEST_F(Sources, OverlookedFrontiersLeadOntoARoom) {
  TourParams much;
  much.overlooked_m2 = 1e6;
  EXPECT_TRUE(overlooked(frontiers(), map_, planner_.analysis.goals, much).empty());
  TourParams little;
  little.overlooked_m2 = 0.01;
  EXPECT_FALSE(overlooked(frontiers(), map_, planner_.analysis.goals, little).empty());
}

/// A hall with a row of pillars that the robot does not fit through, but for the end on the right.
std::vector<std::string> pillared_hall() {
  std::vector<std::string> rows(40, std::string(60, '#'));
  for (std::size_t y = 2; y < 38; ++y) rows[y].replace(2, 56, 56, ' ');
  for (std::size_t x = 2; x < 44; x += 3) rows[24][x] = '#';
  rows[32][30] = 'S';
  return rows;
}

class Shadows : public ToyDecision {
 protected:
  Shadows() : ToyDecision(pillared_hall(), 14.0) {}
  /// Between the shadows of two pillars, 2 m behind them.
  [[nodiscard]] Situation with_goal(analysis::Analysis& analysed) const {
    goals::Goal goal;
    goal.p_map = here() + types::Vector2(-1.9, 4.6);
    goal.opening_m = 2.0;
    analysed = *analysis_;
    analysed.goals.goals = {goal};
    const Situation now = situation();
    return {now.now,      now.T_map_base, now.start,     now.mission, now.battery_low,
            now.feedback, analysed,       now.essential, now.route,   now.team};
  }
};

TEST_F(Shadows, AGoalBetweenThemIsApproachedOverTheLeastThatIsUnseen) {
  analysis::Analysis analysed;
  const Situation now = with_goal(analysed);
  const Reachable essential = essential_candidates(now, map_, deferred_, params_, false);
  EXPECT_TRUE(essential.candidates.empty());
  EXPECT_TRUE(essential.cut_off);
  const auto found = unseen_way_candidates({}, now, map_, deferred_, params_);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(map_.field().can_stay_at(map_.map().index(found[0].cell)));
  EXPECT_GT(found[0].goal.p_map.x(), 10.0) << "where the row ends";
  EXPECT_EQ(found[0].goal.opening_m, 2.0) << "worth as much as the goal";
  params_.candidate.unknown_way_m = 0.1;
  EXPECT_TRUE(unseen_way_candidates({}, now, map_, deferred_, params_).empty());
}

TEST_F(Shadows, APlaceBeforeThemIsVisitedOnce) {
  analysis::Analysis analysed;
  const Situation now = with_goal(analysed);
  const auto found = unseen_way_candidates({}, now, map_, deferred_, params_);
  ASSERT_EQ(found.size(), 1U);
  deferred_.visit(found[0].goal.p_map, std::nullopt);
  EXPECT_TRUE(unseen_way_candidates({}, now, map_, deferred_, params_).empty());
}

TEST_F(Shadows, AFrontierBetweenThemIsSuchAGoal) {
  analysis::Analysis analysed;
  const Situation now = with_goal(analysed);
  analysed.goals.goals.clear();
  std::vector<goals::Frontier> onto_much;
  for (const goals::Frontier& frontier : frontiers()) {
    const bool behind = frontier.centroid.y() > here().y() + 3.0;
    if (behind && std::isinf(map_.field().cost_m[goals::middle_of(map_.map(), frontier.cells)]))
      onto_much.push_back(frontier);
  }
  ASSERT_FALSE(onto_much.empty());
  const auto found = unseen_way_candidates(onto_much, now, map_, deferred_, params_);
  ASSERT_FALSE(found.empty());
  for (const Candidate& c : found) {
    EXPECT_TRUE(std::isinf(c.goal.behind_m2));
    EXPECT_GE(expected_area_m2(c.goal, params_.tour.leads_on_m2, params_.tour), params_.tour.shadow_m2);
  }
}

/// The corridor with something across it, 1.75 m from the robot.
std::vector<std::string> obstructed(std::size_t first_row, std::size_t end_row) {
  std::vector<std::string> rows = corridor_and_rooms();
  for (std::size_t y = first_row; y < end_row; ++y) rows[y].replace(47, 3, 3, '#');
  return rows;
}

class BehindSomebody : public ToyDecision {
 protected:
  BehindSomebody() : ToyDecision(obstructed(12, 15)) {}
};

/// Beside a pier on either side there is as little room as beside a person.
std::vector<std::string> with_piers() {
  std::vector<std::string> rows = obstructed(11, 13);
  for (std::size_t y = 14; y < 16; ++y) rows[y].replace(47, 3, 3, '#');
  return rows;
}

class BehindPiers : public ToyDecision {
 protected:
  BehindPiers() : ToyDecision(with_piers()) {}
};

TEST_F(BehindSomebody, WhereTheyStandIsLookedAtOnce) {
  const auto found = doubted_candidates(situation(), map_, Pursuit(), {}, params_);
  ASSERT_EQ(found.size(), 1U) << "one look for both sides of them";
  EXPECT_EQ(found.front().id.source, Source::kDoubt);
  EXPECT_LT(found.front().goal.p_map.x(), here().x() + 1.75) << "before them";
  EXPECT_GT(found.front().goal.p_map.x(), here().x()) << "on the way to them";
  const std::array looked{found.front().goal.p_map};
  EXPECT_TRUE(doubted_candidates(situation(), map_, Pursuit(), looked, params_).empty());
}

TEST_F(BehindPiers, WallsAreNotLookedAtAgain) {
  EXPECT_TRUE(doubted_candidates(situation(), map_, Pursuit(), {}, params_).empty());
}

TEST_F(BehindPiers, APlaceThatIsPursuedStaysUntilTheRobotHasLooked) {
  Pursuit pursuit;
  goals::Goal goal;
  goal.p_map = here() + types::Vector2(1.0, 0.0);
  pursuit = set_out(std::move(pursuit), goal, {Source::kDoubt, 1}, building_.now(), here());
  const auto found = doubted_candidates(situation(), map_, pursuit, {}, params_);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().goal.p_map, goal.p_map);
  const std::array looked{goal.p_map};
  EXPECT_TRUE(doubted_candidates(situation(), map_, pursuit, looked, params_).empty());
  pursuit.id.source = Source::kGap;
  EXPECT_TRUE(doubted_candidates(situation(), map_, pursuit, {}, params_).empty());
}

TEST_F(Sources, TheFinalSweepWaitsForOtherGoals) {
  params_.final_sweep.promise_min = 0.0;
  SweepState state{FinalSweep(params_.final_sweep), false};
  state.sweep.begin(building_.now());
  const Reachable others = essential_candidates(situation(), map_, deferred_, params_, false);
  EXPECT_TRUE(swept(state, others.candidates, false, situation(), map_, params_).sweep.empty());
  EXPECT_TRUE(swept(state, {}, true, situation(), map_, params_).sweep.empty()) << "a route may open";
  const SweepState begun = swept(state, {}, false, situation(), map_, params_);
  ASSERT_FALSE(begun.sweep.empty());
  const Reachable viewpoints = viewpoint_candidates(begun.sweep, situation(), map_, params_.candidate);
  for (const Candidate& c : viewpoints.candidates) {
    EXPECT_EQ(c.id.source, Source::kViewpoint);
    EXPECT_TRUE(begun.sweep.has(c.id.number));
  }
}

TEST_F(Sources, OnlyACompleteExplorationOfThePapersStrategySweeps) {
  EXPECT_TRUE(has_final_sweep(params_));
  ExplorationParams essential = params_;
  essential.finish = Finish::kEssential;
  EXPECT_FALSE(has_final_sweep(essential));
  ExplorationParams frontier = params_;
  frontier.strategy = Strategy::kMinPos;
  EXPECT_FALSE(has_final_sweep(frontier));
}

TEST_F(Sources, AnEssentialExplorationLeavesGapsForLater) {
  ExplorationParams essential = params_;
  essential.finish = Finish::kEssential;
  const Proposal proposal = propose(situation(), {map_, ways_}, essential, false, deferred_, SweepState{});
  EXPECT_FALSE(proposal.only_gaps);
  for (const Candidate& c : proposal.candidates) EXPECT_EQ(c.id.source, Source::kEssential);
  EXPECT_EQ(proposal.clusters, static_cast<int>(frontiers().size()));
}

TEST_F(Sources, ARobotAloneChoosesWhatATeamOfOneWould) {
  const Proposal proposal = propose(situation(), {map_, ways_}, params_, false, deferred_, SweepState{});
  const Choice choice = chosen(proposal.candidates);
  ASSERT_NE(choice.best, nullptr);
  EXPECT_EQ(choice.bids.size(), proposal.candidates.size()) << "its bids are what it would tell a team";
  std::vector<std::size_t> all(proposal.candidates.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const TravelTable table = travel_table(proposal.candidates, nullptr, here(), searches(), params_.tour);
  const std::size_t first = first_of_tour(all, {proposal.candidates, table, nullptr, 0.0}, params_.tour);
  EXPECT_EQ(choice.best, &proposal.candidates[first]);
}

TEST_F(Sources, AGoalThatACheaperClaimTakesIsLeft) {
  const Proposal proposal = propose(situation(), {map_, ways_}, params_, false, deferred_, SweepState{});
  const Choice alone = chosen(proposal.candidates);
  team::StatusMessage mate;
  mate.robot = 1;
  mate.duty = team::Duty::kAble;
  mate.T_map_base = {500.0, 0.0, 0.0};
  mate.claim = team::Bid{place_for_team(alone.best->goal), 0.1};
  mate.bids = {*mate.claim};
  hear(mate);
  const Choice shared = chosen(proposal.candidates);
  EXPECT_EQ(shared.bids.size(), proposal.candidates.size());
  if (shared.best != nullptr) {
    EXPECT_FALSE(team::is_same_goal(place_for_team(shared.best->goal), mate.claim->p_map));
  }
}

}  // namespace
}  // namespace topo::exploration
