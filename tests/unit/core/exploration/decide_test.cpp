// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "core/exploration/choice.hpp"
#include "core/exploration/sources.hpp"
#include "tests/unit/core/exploration/toy_decision.hpp"

namespace topo::exploration {
namespace {

using std::chrono::seconds;
using types::Vector2;

class Deciding : public ToyDecision {
 protected:
  [[nodiscard]] Intent begun(Order order = Order::kExplore) const {
    Intent intent;
    intent.sweep.sweep = FinalSweep(params_.final_sweep);
    return begin_mission(std::move(intent), order, building_.now());
  }
  [[nodiscard]] Intent after(const Situation& now, Intent intent) {
    return decide(now, searches(), params_, std::move(intent));
  }
  [[nodiscard]] Intent first() { return after(situation(), begun()); }
  [[nodiscard]] Situation reported(const Intent& intent, bool arrived, bool stuck) const {
    Situation now = situation();
    now.feedback = {intent.pursuit.number, arrived, stuck};
    return now;
  }
};

TEST_F(Deciding, WhatIsRememberedByItsPlaceMovesWithTheMap) {
  std::vector<types::KeyframePose> keyframes{{building_.now(), {0.0, 0.0, 0.0}}};
  types::MapAnchors anchors;
  (void)anchors.take(keyframes, 0.1, 0.03);
  keyframes[0].T_map_base = {5.0, 0.0, 0.0};
  const auto correction = anchors.take(keyframes, 0.1, 0.03);
  ASSERT_TRUE(correction);
  Intent intent = begun();
  const Vector2 was{1.0, 2.0}, is{6.0, 2.0};
  intent.deferred.visit(was, std::nullopt);
  intent.obstacles.note_touch(was, building_.now());
  intent.obstacles.close_passage(was);
  intent.contact = team::LastContact(1.0);
  intent.contact.heard(was, building_.now());
  intent.sweep.looked_again = {was};
  intent.attempts.turned_at = intent.attempts.looked_from = was;
  intent = moved(std::move(intent), *correction);
  EXPECT_FALSE(intent.deferred.hold(was, building_.now())) << "a door that is there now";
  EXPECT_TRUE(intent.deferred.hold(is, building_.now()));
  EXPECT_EQ(intent.obstacles.echoed(), std::vector<Vector2>{is});
  EXPECT_EQ(intent.obstacles.stuck_on(), std::vector<Vector2>{is});
  EXPECT_EQ(intent.contact.lost_at(building_.now() + seconds(9)), is);
  EXPECT_EQ(intent.sweep.looked_again, std::vector<Vector2>{is});
  EXPECT_EQ(intent.attempts.turned_at, is);
  EXPECT_EQ(intent.attempts.looked_from, is);
}

TEST_F(Deciding, AGoalIsNotChargedWithAPause) {
  Intent intent;
  intent.pursuit.taken = building_.now() - seconds(200);
  intent.pursuit.last_progress = building_.now() - seconds(10);
  EXPECT_EQ(held_up(intent, seconds(500)).attempts.nothing_since, types::Stamp{}) << "there is a goal";
  intent.attempts.nothing_since = building_.now() - seconds(5);
  const Intent held = held_up(intent, seconds(500));
  EXPECT_EQ(held.attempts.nothing_since, building_.now() + seconds(495));
  const auto settled_at = [&](const Pursuit& pursuit, int later_s) {
    return settled(pursuit, {1}, {9.0, 9.0}, {0.0, 0.0}, 0.5, building_.now() + seconds(later_s),
                   params_.pursuit);
  };
  EXPECT_EQ(settled_at(intent.pursuit, 500), Settled::kNoProgress);
  EXPECT_EQ(settled_at(held.pursuit, 500), Settled::kUnderWay);
  for (const int later_s : {0, 5, 60, 300})
    EXPECT_EQ(settled_at(held.pursuit, 500 + later_s), settled_at(intent.pursuit, later_s)) << later_s;
}

TEST_F(Deciding, ANewMissionForgetsTheOldOne) {
  for (const Order order : {Order::kStand, Order::kExplore, Order::kHome, Order::kGoTo}) {
    Intent old;
    old.pursuit.goal = goals::Goal{};
    old.pursuit.has_target = true;
    old.pursuit.number = 8;
    old.attempts = {3, 2, 1, building_.now()};
    old.deferred.visit({1.0, 1.0}, std::nullopt);
    old.sweep.meanwhile = true;
    old.offer.bids.push_back({});
    old.offer.home = team::Home{};
    old.offer.ignore_passing_until = building_.now() + seconds(9);
    old.contact = team::LastContact(1.0);
    old.contact.heard({1.0, 1.0}, building_.now() - seconds(9));
    old.obstacles.close_passage({1.0, 1.0});
    old.outlook.open_goals.push_back({});
    old.log.note(building_.now(), {1.0, 1.0}, "old");
    const Intent intent = begin_mission(old, order, building_.now());
    EXPECT_FALSE(intent.pursuit.goal || intent.pursuit.has_target);
    EXPECT_EQ(intent.pursuit.number, 8U) << "numbers count on: control's last report is about the old one";
    EXPECT_EQ(intent.attempts.resumed + intent.attempts.stuck, 0);
    EXPECT_EQ(intent.attempts.nothing_since, types::Stamp{});
    EXPECT_TRUE(intent.deferred.held(building_.now()).empty());
    EXPECT_FALSE(intent.sweep.meanwhile);
    EXPECT_TRUE(intent.offer.bids.empty() && !intent.offer.home);
    EXPECT_LE(intent.offer.ignore_passing_until, building_.now());
    EXPECT_FALSE(intent.contact.lost_at(building_.now()));
    EXPECT_TRUE(intent.obstacles.stuck_on().empty() && intent.outlook.open_goals.empty());
    EXPECT_EQ(intent.log.decisions.empty(), order == Order::kExplore) << "others are part of an exploration";
    EXPECT_EQ(intent.reason, order == Order::kStand ? "standing, as told" : "");
  }
}

TEST_F(Deciding, TheFirstDecisionTakesAGoal) {
  const Intent intent = first();
  EXPECT_TRUE(std::holds_alternative<Exploring>(intent.phase));
  ASSERT_TRUE(intent.pursuit.goal && intent.pursuit.has_target);
  EXPECT_TRUE(has_note(intent, "taken: "));
  EXPECT_EQ(intent.log.goals_issued, 1U);
  EXPECT_EQ(intent.log.decisions_made, 1U);
  EXPECT_EQ(intent.log.goals_sum, intent.outlook.open_goals.size());
  EXPECT_TRUE(std::isfinite(map_.field().cost_m[map_.map().index(intent.pursuit.target)]));
}

TEST_F(Deciding, WithoutNewsTheGoalIsKept) {
  const Intent once = first(), twice = after(situation(), once);
  EXPECT_EQ(twice.pursuit.number, once.pursuit.number);
  EXPECT_EQ(twice.pursuit.id, once.pursuit.id);
  EXPECT_EQ(twice.log.goals_issued, 1U);
  EXPECT_EQ(twice.log.decisions_made, 2U);
}

TEST_F(Deciding, AGoalThatControlArrivedAtIsNotGoneToAgain) {
  const Intent once = first(), then = after(reported(once, true, false), once);
  const Vector2 reached = once.pursuit.goal->p_map;
  EXPECT_TRUE(has_note(then, "reached"));
  ASSERT_EQ(then.deferred.visited(building_.now()).size(), 1U);
  EXPECT_EQ(then.deferred.visited(building_.now()).front(), reached);
  EXPECT_TRUE(then.deferred.hold(reached, building_.now() + seconds(3600))) << "a final sweep follows";
  ASSERT_TRUE(then.pursuit.goal);
  EXPECT_GT((then.pursuit.goal->p_map - reached).norm(), params_.deferral.same_m);
  EXPECT_GT(then.pursuit.number, once.pursuit.number);
}

TEST_F(Deciding, WithoutAFinalSweepAVisitedGoalComesBack) {
  params_.finish = Finish::kEssential;
  const Intent once = first(), then = after(reported(once, true, false), once);
  EXPECT_TRUE(then.deferred.hold(once.pursuit.goal->p_map, building_.now() + seconds(299)));
  EXPECT_FALSE(then.deferred.hold(once.pursuit.goal->p_map, building_.now() + seconds(301)));
}

TEST_F(Deciding, AGoalThatControlIsStuckOnIsGivenUpForAMinute) {
  const Intent once = first(), then = after(reported(once, false, true), once);
  const Vector2 given_up = once.pursuit.goal->p_map;
  EXPECT_TRUE(has_note(then, "given up: stuck on the way"));
  EXPECT_TRUE(then.deferred.hold(given_up, building_.now() + seconds(59)));
  EXPECT_FALSE(then.deferred.hold(given_up, building_.now() + seconds(61)));
  EXPECT_FALSE(then.obstacles.stuck_on().empty());
}

TEST_F(Deciding, AReportOnAnotherGoalIsNone) {
  const Intent once = first();
  Situation now = reported(once, true, true);
  ++now.feedback.number;
  const Intent then = after(now, once);
  EXPECT_EQ(then.pursuit.number, once.pursuit.number);
  EXPECT_TRUE(then.deferred.held(building_.now()).empty());
}

TEST_F(Deciding, AStandingRobotGivesItsGoalUp) {
  const Intent once = first();
  Situation now = situation();
  now.now += seconds(26);
  EXPECT_TRUE(has_note(after(now, once), "given up: no progress"));
}

TEST_F(Deciding, WithoutAGoalInReachThoseGivenUpAreTriedAgain) {
  params_.finish = Finish::kEssential;
  params_.tour.overlooked_m2 = 1e6;  // no gaps
  Intent intent = first();
  for (const goals::Goal& goal : intent.outlook.open_goals)
    intent.deferred.give_up(goal.p_map, building_.now() + seconds(500), "stuck");
  const Intent again = after(situation(), intent);
  EXPECT_TRUE(again.outlook.open_goals.empty());
  EXPECT_EQ(again.reason, "only goals given up before are left: they are tried again");
  EXPECT_FALSE(again.pursuit.has_target);
  const Intent retried = after(situation(), again);
  EXPECT_TRUE(retried.pursuit.has_target);
}

/// Goals that are none whenever the robot turns to them would keep it for ever.
TEST_F(Deciding, ThoseGivenUpAreTriedAgainOnlySoOftenBeforeOneIsReached) {
  params_.finish = Finish::kEssential;
  params_.tour.overlooked_m2 = 1e6;  // no gaps
  Intent intent = first();
  const std::vector<goals::Goal> goals = intent.outlook.open_goals;
  const auto lost_all = [&](Intent now) {
    for (const goals::Goal& goal : goals)
      for (int twice = 0; twice < 2; ++twice) now.deferred.vanish(goal.p_map, building_.now() + seconds(500));
    now.pursuit.goal.reset();
    return now;
  };
  for (int k = 0; k < params_.ending.recalls_max; ++k) {
    intent = after(situation(), lost_all(std::move(intent)));
    EXPECT_EQ(intent.reason, "only goals given up before are left: they are tried again");
  }
  const Intent tried = after(situation(), intent);
  ASSERT_TRUE(tried.pursuit.goal);
  EXPECT_EQ(after(reported(tried, true, false), tried).attempts.recalled, 0) << "one was reached";
  const Intent ended = after(situation(), lost_all(intent));
  EXPECT_EQ(ended.reason, "explored: no goal is left in reach");
}

TEST_F(Deciding, ALowBatteryLeadsHome) {
  Situation low = situation();
  low.start = here() - Vector2(3.0, 0.0);
  low.battery_low = true;
  const Intent then = after(low, first());
  ASSERT_TRUE(std::holds_alternative<Returning>(then.phase));
  EXPECT_TRUE(std::get<Returning>(then.phase).cut_short);
  EXPECT_TRUE(has_note(then, "home: the battery is low"));
  ASSERT_TRUE(then.pursuit.has_target);
  EXPECT_LT((map_.map().centre_of(then.pursuit.target) - low.start).norm(), 0.1);
  const Intent still = after(low, then);
  EXPECT_TRUE(is_homing(still.phase)) << "though there are goals";
  EXPECT_EQ(still.log.decisions.size(), then.log.decisions.size()) << "noted once";
}

TEST_F(Deciding, AnExplorationOnItsWayHomeTurnsRoundForAGoal) {
  Intent homing = first();
  homing.phase = Returning{"explored", false};
  Situation now = situation();
  now.start = here() - Vector2(3.0, 0.0);
  const Intent resumed = after(now, homing);
  EXPECT_TRUE(std::holds_alternative<Exploring>(resumed.phase));
  EXPECT_EQ(resumed.attempts.resumed, 1);
  homing.attempts.resumed = params_.ending.resumes_max;
  EXPECT_TRUE(is_homing(after(now, homing).phase)) << "often enough";
  homing.attempts.resumed = 0;
  now.mission.order = Order::kHome;
  EXPECT_TRUE(is_homing(after(now, homing).phase)) << "as ordered";
}

TEST_F(Deciding, AnOrderOfAPlaceIsGoneToWhateverGoalsThereAre) {
  Situation now = situation();
  now.mission = {2, Order::kGoTo, false, here() + Vector2(2.0, 0.0)};
  const Intent then = after(now, begun(Order::kGoTo));
  EXPECT_TRUE(std::holds_alternative<GoingTo>(then.phase));
  EXPECT_LT((map_.map().centre_of(then.pursuit.target) - now.mission.target).norm(), 0.1);
}

TEST_F(Deciding, ARobotThatStandsAsideDecidesNothingElse) {
  team::StatusMessage mate = mate_at(7, here() + Vector2(2.0, 0.0));
  for (double x = 2.0; x > -3.0; x -= 0.3) mate.way_map.push_back(here() + Vector2(x, 0.0));
  hear(mate);
  const Intent then = after(situation(), begun());
  EXPECT_TRUE(std::holds_alternative<MakingWay>(then.phase));
  EXPECT_EQ(then.log.decisions_made, 0U);
}

TEST_F(Deciding, WithAllGoalsClaimedTheRobotWaits) {
  const Intent alone = first();
  team::StatusMessage mate = mate_at(1, {500.0, 0.0});
  for (const goals::Goal& goal : alone.outlook.open_goals) mate.bids.push_back({place_for_team(goal), 0.01});
  mate.claim = mate.bids.front();
  hear(mate);
  const Intent then = after(situation(), begun());
  EXPECT_FALSE(then.pursuit.goal || then.pursuit.has_target);
  EXPECT_EQ(then.reason, "waits: others are nearer to every goal");
  EXPECT_EQ(then.offer.bids.size(), then.outlook.open_goals.size());
}

TEST_F(Deciding, WithTheOnlyGoalClaimedTheRobotWaits) {
  params_.finish = Finish::kEssential;
  params_.tour.overlooked_m2 = 1e6;  // no gaps
  const Intent alone = first();
  const std::vector<goals::Goal>& goals = alone.outlook.open_goals;
  Intent intent = begun();
  for (std::size_t i = 1; i < goals.size(); ++i) intent.deferred.visit(goals[i].p_map, std::nullopt);
  team::StatusMessage mate = mate_at(1, {500.0, 0.0});
  mate.bids = {{place_for_team(goals.front()), 0.01}};
  mate.claim = mate.bids.front();
  hear(mate);
  const Intent then = after(situation(), intent);
  EXPECT_FALSE(then.pursuit.goal || then.pursuit.has_target);
  EXPECT_EQ(then.reason, "waits: others are nearer to every goal");
  EXPECT_EQ(then.offer.bids.size(), then.outlook.open_goals.size());
}

TEST_F(Deciding, WithoutAGoalOfItsOwnTheRobotHelps) {
  const Intent alone = first();
  team::StatusMessage mate = mate_at(1, {500.0, 0.0});
  mate.bids = alone.offer.bids;  // nearer to each, but it goes to the first before
  for (team::Bid& bid : mate.bids) bid.cost_m -= 0.5;
  mate.claim = mate.bids.front();
  hear(mate);
  const Intent then = after(situation(), begun());
  ASSERT_TRUE(then.pursuit.goal);
  EXPECT_FALSE(team::is_same_goal(place_for_team(*then.pursuit.goal), mate.claim->p_map));
}

TEST_F(Deciding, NothingEndsOnAnAnalysisOfAnOlderMap) {
  params_.finish = Finish::kWorth;
  params_.worth.rate_m2ps = 1e6;
  analysis::Analysis old = *analysis_;
  --old.revision;
  analysis_ = std::make_shared<const analysis::Analysis>(std::move(old));
  const Intent intent = after(situation(), begun());
  EXPECT_TRUE(std::holds_alternative<Exploring>(intent.phase));
  EXPECT_EQ(intent.reason, "waits for the analysis of the newest map");
}

TEST_F(Deciding, WhatIsNotWorthItsTimeIsLeftOut) {
  params_.finish = Finish::kWorth;
  params_.worth.rate_m2ps = 1e6;
  Situation now = situation();
  now.start = here() - Vector2(3.0, 0.0);
  const Intent intent = after(now, begun());
  EXPECT_TRUE(intent.outlook.open_goals.empty());
  EXPECT_FALSE(intent.outlook.left_out.empty());
  ASSERT_TRUE(std::holds_alternative<Returning>(intent.phase)) << intent.reason;
  EXPECT_TRUE(std::get<Returning>(intent.phase).why.starts_with("explored: goals that are not worth"));
  EXPECT_TRUE(has_note(intent, "left out: "));
  params_.worth.rate_m2ps = 1e-6;
  EXPECT_TRUE(first().outlook.left_out.empty());
}

/// All there is to choose among, and a choice among some of it.
class FirstOfTour : public Deciding {
 protected:
  FirstOfTour() : all_(propose(situation(), searches(), params_, false, deferred_, SweepState{}).candidates) {
    for (std::size_t i = 0; i < all_.size(); ++i) everything_.push_back(i);
  }
  [[nodiscard]] const Candidate* first(const std::vector<std::size_t>& share, const Candidate* present,
                                       const TourParams& params) {
    const TravelTable table = travel_table(all_, present, here(), searches(), params);
    return &all_[first_of_tour(share, {all_, table, present, 0.0}, params)];
  }
  std::vector<Candidate> all_;
  std::vector<std::size_t> everything_;
};

TEST_F(FirstOfTour, OfOneIsThat) {
  ASSERT_GE(all_.size(), 2U);
  for (std::size_t i = 0; i < all_.size(); ++i) EXPECT_EQ(first({i}, nullptr, params_.tour), &all_[i]);
}

TEST_F(FirstOfTour, DoesNotDependOnTheOrder) {
  std::vector<std::size_t> share = everything_;
  const Candidate* const one = first(share, nullptr, params_.tour);
  for (std::size_t k = 0; k < share.size(); ++k) {
    std::ranges::rotate(share, share.begin() + 1);
    EXPECT_EQ(first(share, nullptr, params_.tour), one);
  }
}

TEST_F(FirstOfTour, ThePresentGoalStaysUnlessMuchIsSaved) {
  TourParams patient = params_.tour, hasty = params_.tour;
  patient.switch_share = 1e9;
  hasty.switch_share = 0.0;
  const Candidate* const one = first(everything_, nullptr, params_.tour);
  for (const Candidate& present : all_) {
    EXPECT_EQ(first(everything_, &present, patient), &present);
    patient.goals_max = 1;
    EXPECT_EQ(first(everything_, &present, patient), &present) << "it is in the table";
    patient.goals_max = 20;
  }
  EXPECT_EQ(first(everything_, one, hasty), one);
}

TEST_F(FirstOfTour, AmongOneGoalTheNearestIsLooked) {
  params_.tour.goals_max = 1;
  const Candidate* const one = first(everything_, nullptr, params_.tour);
  for (const Candidate& c : all_) EXPECT_LE(one->cost_m, c.cost_m);
}

TEST_F(FirstOfTour, BeyondTheTableTheNearestIsTaken) {
  params_.tour.goals_max = 1;
  std::ranges::sort(everything_, {}, [&](std::size_t i) { return all_[i].cost_m; });
  const std::vector<std::size_t> beyond(everything_.begin() + 1, everything_.end());
  ASSERT_FALSE(beyond.empty());
  EXPECT_EQ(first(beyond, nullptr, params_.tour), &all_[beyond.front()]);
}

}  // namespace
}  // namespace topo::exploration
