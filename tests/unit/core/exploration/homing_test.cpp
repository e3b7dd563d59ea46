// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/unit/core/exploration/toy_decision.hpp"

namespace topo::exploration {
namespace {

using std::chrono::seconds;
using types::Vector2;

class Homing : public ToyDecision {
 protected:
  /// The robot entered so far from where it is.
  [[nodiscard]] Situation away_from_home(double x_m) const {
    Situation now = situation();
    now.start = here() - Vector2(x_m, 0.0);
    return now;
  }
  [[nodiscard]] static Intent returning(bool cut_short = false) {
    Intent intent;
    intent.phase = Returning{cut_short ? "the battery is low" : "explored", cut_short};
    return intent;
  }
  [[nodiscard]] Intent home(const Situation& now, Intent intent) {
    return go_home(now, searches(), params_, std::move(intent));
  }
  [[nodiscard]] Intent to_target(const Situation& now, Intent intent) {
    return go_to_target(now, searches(), params_, std::move(intent));
  }
  [[nodiscard]] Situation ordered_to(const Vector2& p_map) const {
    Situation now = situation();
    now.mission = {2, Order::kGoTo, false, p_map};
    return now;
  }
  [[nodiscard]] static Intent going() {
    Intent intent;
    intent.phase = GoingTo{};
    return intent;
  }
};

TEST_F(Homing, TheRobotIsBoundForItsStart) {
  const Situation now = away_from_home(3.0);
  const Intent after = home(now, returning());
  EXPECT_TRUE(std::holds_alternative<Returning>(after.phase));
  EXPECT_EQ(after.reason, "explored");
  ASSERT_TRUE(after.pursuit.has_target);
  EXPECT_LT((map_.map().centre_of(after.pursuit.target) - now.start).norm(), 0.1);
  EXPECT_EQ(home(now, after).pursuit.number, after.pursuit.number) << "one way home";
}

TEST_F(Homing, AtItsStartTheMissionIsDone) {
  const Intent after = home(away_from_home(0.14), returning());
  EXPECT_TRUE(std::holds_alternative<Done>(after.phase));
  EXPECT_EQ(after.reason, "explored");
  EXPECT_FALSE(after.pursuit.has_target);
  EXPECT_TRUE(std::holds_alternative<Returning>(home(away_from_home(0.16), returning()).phase));
}

TEST_F(Homing, CutShortByTheBatteryItHasFailed) {
  const Intent after = home(away_from_home(0.1), returning(true));
  EXPECT_TRUE(std::holds_alternative<Failed>(after.phase));
  EXPECT_EQ(after.reason, "the battery is low: came home");
}

TEST_F(Homing, OnTheOperatorsOrderItHasArrived) {
  Situation now = away_from_home(0.1);
  now.mission.order = Order::kHome;
  EXPECT_EQ(home(now, returning()).reason, "arrived");
}

TEST_F(Homing, TheEndOfControlsPathCountsWithinTwiceTheReach) {
  for (const double x_m : {0.39, 0.41}) {
    Situation now = away_from_home(x_m);
    const Intent bound = home(now, returning());
    now.feedback = {bound.pursuit.number, true, false};
    EXPECT_EQ(std::holds_alternative<Done>(home(now, bound).phase), x_m < 0.4) << x_m;
    now.feedback.number += 1;
    EXPECT_TRUE(std::holds_alternative<Returning>(home(now, bound).phase)) << "about another way";
  }
}

/// At 1 m/s an exploration ended while its robot passed the start: it was done at once, and stood 0.9 m on.
TEST_F(Homing, WhoPassesItsStartAtSpeedIsNotThere) {
  Situation now = away_from_home(0.1);
  now.feedback.v_mps = 0.8;
  const Intent passing = home(now, returning());
  EXPECT_TRUE(std::holds_alternative<Returning>(passing.phase));
  EXPECT_TRUE(passing.pursuit.has_target) << "it comes back";
  now.feedback.v_mps = 0.5;
  EXPECT_TRUE(std::holds_alternative<Done>(home(now, passing).phase));
  now.feedback = {passing.pursuit.number, false, true, 0.8};
  EXPECT_TRUE(std::holds_alternative<Done>(home(now, passing).phase)) << "stuck, whatever its wheels say";
}

TEST_F(Homing, StuckHalfAMetreAwayIsThereAndElseAnObstacle) {
  for (const double x_m : {0.44, 0.6}) {
    Situation now = away_from_home(x_m);
    const Intent bound = home(now, returning());
    now.feedback = {bound.pursuit.number, false, true};
    const Intent after = home(now, bound);
    EXPECT_EQ(std::holds_alternative<Done>(after.phase), x_m < 0.45);
    EXPECT_EQ(after.obstacles.stuck_on().empty(), x_m < 0.45);
    if (x_m < 0.45) continue;
    EXPECT_EQ(after.pursuit.number, bound.pursuit.number + 1) << "another way";
  }
}

TEST_F(Homing, HeldBesideItsStartInATeamItIsThereForTheOthersAndForItself) {
  const double at_start_m = roster_.params().at_start_m;
  team::StatusMessage mate = mate_at(7, {500.0, 0.0});
  mate.duty = team::Duty::kOver;
  hear(mate);
  for (const double x_m : {at_start_m - 0.02, at_start_m + 0.02}) {
    Situation now = away_from_home(x_m);
    const Intent bound = home(now, returning());
    now.feedback = {bound.pursuit.number, false, true};
    EXPECT_EQ(std::holds_alternative<Done>(home(now, bound).phase), x_m < at_start_m) << x_m;
    now.feedback.stuck = false;
    EXPECT_TRUE(std::holds_alternative<Returning>(home(now, bound).phase));
    now.now += params_.pursuit.standstill + seconds(1);
    EXPECT_EQ(std::holds_alternative<Done>(home(now, bound).phase), x_m < at_start_m)
        << "without a route control has nothing to report";
  }
}

TEST_F(Homing, HeldBeforeAStartFartherInItIsHomeAtTheOneWhereItStands) {
  team::StatusMessage mate = mate_at(7, {500.0, 0.0});
  mate.start = here() + Vector2(3.5, 0.0);
  hear(mate);
  for (const double x_m : {0.5, 2.0}) {
    Situation now = away_from_home(x_m);
    const Intent bound = home(now, returning());
    ASSERT_TRUE(bound.offer.home);
    ASSERT_EQ(bound.offer.home->robot, 7U);
    now.now += params_.pursuit.standstill + seconds(1);
    mate.sequence += 1;
    roster_.take(mate, now.now);
    const Intent after = home(now, bound);
    ASSERT_TRUE(after.offer.home);
    EXPECT_EQ(after.offer.home->robot, x_m < 1.0 ? 5U : 7U) << "its own start is beside it, or is not";
    EXPECT_EQ(std::holds_alternative<WaitingAtHome>(after.phase), x_m < 1.0);
  }
}

TEST_F(Homing, FourStandstillsAreAFailure) {
  const Intent bound = home(away_from_home(3.0), returning());
  Situation now = away_from_home(3.0);
  now.now += seconds(100);
  EXPECT_TRUE(std::holds_alternative<Returning>(home(now, bound).phase));
  now.now += seconds(1);
  const Intent after = home(now, bound);
  EXPECT_TRUE(std::holds_alternative<Failed>(after.phase));
  EXPECT_EQ(after.reason, "no progress for 100 s");
  now.T_map_base.x_m += 0.6;
  EXPECT_TRUE(std::holds_alternative<Returning>(home(now, bound).phase)) << "it gets on";
}

TEST_F(Homing, WithMatesOutTheRobotWaitsForThem) {
  team::StatusMessage mate = mate_at(7, {500.0, 0.0});
  hear(mate);
  const Situation now = away_from_home(0.3);
  const Intent waiting = home(now, returning());
  EXPECT_TRUE(std::holds_alternative<WaitingAtHome>(waiting.phase));
  EXPECT_EQ(waiting.reason, "home, waits for the others");
  ASSERT_TRUE(waiting.offer.home);
  EXPECT_EQ(waiting.offer.home->robot, 5U) << "its own start: no way leads to the mate's";
  mate.duty = team::Duty::kOver;
  mate.sequence = 2;
  hear(mate);
  EXPECT_TRUE(std::holds_alternative<Done>(home(now, returning()).phase));
}

TEST_F(Homing, OrderedHomeItDoesNotWait) {
  hear(mate_at(7, {500.0, 0.0}));
  Situation now = away_from_home(0.1);
  now.mission.order = Order::kHome;
  EXPECT_TRUE(std::holds_alternative<Done>(home(now, returning()).phase));
}

TEST_F(Homing, AmongATeamsStartsTheFarthestInComesFirst) {
  team::StatusMessage mate = mate_at(7, {500.0, 0.0});
  mate.start = here() + Vector2(3.5, 0.0);
  hear(mate);
  const Intent after = home(away_from_home(2.0), returning());
  ASSERT_TRUE(after.offer.home);
  EXPECT_EQ(after.offer.home->robot, 7U);
  EXPECT_LT((map_.map().centre_of(after.pursuit.target) - mate.start).norm(), 0.1);
}

TEST_F(Homing, AnotherHomeIsAnotherWay) {
  hear(mate_at(7, {500.0, 0.0}));
  Intent bound = home(away_from_home(2.0), returning());
  EXPECT_FALSE(home(away_from_home(2.0), bound).is_outdated);
  bound.offer.home = team::Home{7, {500.0, 0.0}};  // no way leads there any more
  const Intent after = home(away_from_home(2.0), bound);
  EXPECT_TRUE(after.is_outdated);
  EXPECT_EQ(after.offer.home->robot, 5U);
  EXPECT_GT(after.pursuit.number, bound.pursuit.number);
}

TEST_F(Homing, ATargetIsApproachedAndArrivedAt) {
  const Vector2 target = here() + Vector2(2.0, 0.0);
  Situation now = ordered_to(target);
  const Intent bound = to_target(now, going());
  EXPECT_TRUE(std::holds_alternative<GoingTo>(bound.phase));
  EXPECT_EQ(bound.reason, "on the operator's order");
  ASSERT_TRUE(bound.pursuit.has_target);
  EXPECT_LT((map_.map().centre_of(bound.pursuit.target) - target).norm(), 0.1);
  now.T_map_base.x_m += 1.9;
  const Intent after = to_target(now, bound);
  EXPECT_TRUE(std::holds_alternative<Done>(after.phase));
  EXPECT_EQ(after.reason, "arrived");
}

TEST_F(Homing, ATargetOutOfReachFailsInTheEnd) {
  Situation now = ordered_to({100.0, 100.0});
  Intent intent = going();
  intent.obstacles.close_passage(here() + Vector2(2.0, 0.0));
  const Intent waits = to_target(now, std::move(intent));
  EXPECT_TRUE(std::holds_alternative<GoingTo>(waits.phase));
  EXPECT_FALSE(waits.pursuit.has_target);
  EXPECT_EQ(waits.reason, "no way there just now");
  EXPECT_TRUE(waits.obstacles.stuck_on().empty()) << "what was too tight may be the only way";
  now.now += seconds(101);
  EXPECT_TRUE(std::holds_alternative<Failed>(to_target(now, waits).phase));
}

/// The robot came to the middle of the corridor along it, and the map says that something closes it now.
class ClosedHome : public Homing {
 protected:
  ClosedHome() {
    for (double x_m = -3.0; x_m <= 0.0; x_m += 0.4)
      way_.push_back(
          {types::Stamp{}, types::Transform2<types::Map, types::Base>(here().x() + x_m, here().y(), 0.0)});
  }
  /// Closes the corridor so far behind the robot.
  [[nodiscard]] Situation closed_at(double x_m) {
    const Vector2 start = here() - Vector2(3.0, 0.0);
    travel::Overlays overlays;
    for (double y_m = -0.6; y_m <= 0.6; y_m += 0.1)
      overlays.stuck_on.emplace_back(here().x() - x_m, here().y() + y_m);
    map_.begin(building_.snapshot().keyframes.back(), {}, overlays);
    map_.settle(HUGE_VAL);
    Situation now = situation();
    now.start = start;
    now.driven = way_;
    return now;
  }
  std::vector<types::KeyframePose> way_;
};

TEST_F(ClosedHome, TheRobotLooksAtWhatClosesItsWay) {
  const Situation now = closed_at(2.3);
  const Intent looks = home(now, returning());
  EXPECT_TRUE(std::holds_alternative<Returning>(looks.phase));
  ASSERT_TRUE(looks.pursuit.has_target);
  EXPECT_TRUE(looks.reason.starts_with("no way there just now: looks at what closes")) << looks.reason;
  const Vector2 target = map_.map().centre_of(looks.pursuit.target);
  EXPECT_GT(target.x(), here().x() - 1.5) << "not at the obstacle";
  EXPECT_LT(target.x(), here().x() - 0.5);
}

TEST_F(ClosedHome, TheRobotTurnsToItWhenItIsThere) {
  const Intent looks = home(closed_at(1.3), returning());
  EXPECT_FALSE(looks.pursuit.has_target);
  ASSERT_TRUE(looks.pursuit.turn_to_rad);
  EXPECT_NEAR(std::abs(*looks.pursuit.turn_to_rad), 3.1416, 0.1);
  Situation open = away_from_home(3.0);
  open.driven = way_;
  map_.begin(building_.snapshot().keyframes.back(), {}, {});
  const Intent goes = home(open, looks);
  EXPECT_TRUE(goes.pursuit.has_target);
  EXPECT_FALSE(goes.pursuit.turn_to_rad);
}

TEST_F(ClosedHome, WhatStaysClosedIsAFailureInTheEnd) {
  Situation now = closed_at(1.3);
  const Intent looks = home(now, returning());
  now.now += seconds(101);
  EXPECT_TRUE(std::holds_alternative<Failed>(home(now, looks).phase));
}

/// Before a robot that stood for good one went to and fro for an hour.
TEST_F(ClosedHome, ToAndFroBeforeItIsNoProgress) {
  const Situation now = closed_at(1.3);
  Intent intent = home(now, returning());
  int times = 0;
  for (; times < 20 && std::holds_alternative<Returning>(intent.phase); ++times) {
    Situation later = now;
    later.now += seconds(10 * (times + 1));
    later.T_map_base.x_m += times % 2 == 0 ? 1.0 : 0.0;
    intent = home(later, intent);
  }
  EXPECT_TRUE(std::holds_alternative<Failed>(intent.phase));
  EXPECT_EQ(times, 17) << "four looks in 60 s, and 100 s more";
}

TEST_F(ClosedHome, WhoWaitedLongAndGetsOnDoesNotFail) {
  const Intent looks = home(closed_at(1.3), returning());
  map_.begin(building_.snapshot().keyframes.back(), {}, {});
  map_.settle(HUGE_VAL);
  Situation later = away_from_home(3.0);
  later.driven = way_;
  Intent intent = looks;
  for (int s = 92; s < 106; ++s) {
    later.now = building_.now() + seconds(s);
    later.T_map_base.x_m = here().x() - 0.2 * (s - 92);
    intent = home(later, intent);
    ASSERT_TRUE(std::holds_alternative<Returning>(intent.phase)) << s;
    ASSERT_TRUE(intent.pursuit.has_target);
  }
}

TEST_F(ClosedHome, OnAnOrderToGoElsewhereItWaitsWhereItIs) {
  Situation now = closed_at(2.3);
  now.mission = {2, Order::kGoTo, false, now.start};
  const Intent waits = to_target(now, going());
  EXPECT_FALSE(waits.pursuit.has_target);
  EXPECT_FALSE(waits.pursuit.turn_to_rad);
}

}  // namespace
}  // namespace topo::exploration
