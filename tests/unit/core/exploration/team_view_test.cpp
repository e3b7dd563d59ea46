// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/team_view.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

#include "core/exploration/decision_log.hpp"
#include "core/exploration/params.hpp"

namespace topo::exploration {
namespace {

using types::Vector2;

const types::Stamp kToday = types::stamp_from_seconds(5000.0);
types::Stamp after(double t_s) { return kToday + types::from_seconds(t_s); }

team::StatusMessage able_mate(std::uint16_t robot, const types::Se2& T_map_base) {
  team::StatusMessage mate;
  mate.robot = robot;
  mate.sequence = 1;
  mate.T_map_base = T_map_base;
  mate.duty = team::Duty::kAble;
  return mate;
}

team::Roster roster_of(const std::vector<team::StatusMessage>& mates) {
  team::Roster roster;
  for (const team::StatusMessage& mate : mates) roster.take(mate, kToday);
  return roster;
}

TEST(TeamView, AMateThatGoesOnIsWithinItsSwingRadius) {
  const std::vector<Vector2> going{{1.0, 0.0}, {9.0, 9.0}};
  EXPECT_TRUE(is_going_mate(going, {1.74, 0.0}, 0.75));
  EXPECT_FALSE(is_going_mate(going, {1.76, 0.0}, 0.75));
  EXPECT_TRUE(is_going_mate(going, {9.0, 9.0}, 0.75));
  EXPECT_FALSE(is_going_mate({}, {1.0, 0.0}, 0.75));
}

TEST(TeamView, TheBeginningOfARouteIsThinnedOutAndSixMetresLong) {
  EXPECT_TRUE(rc::check([] {
    std::vector<Vector2> route(1, Vector2(1.0, 2.0));
    double length_m = 0.0;
    std::vector<double> gone_m(1, 0.0);
    for (int k = *rc::gen::inRange(0, 120); k > 0; --k) {
      const double step_m = 0.01 * *rc::gen::inRange(1, 25), angle_rad = 0.1 * *rc::gen::inRange(0, 63);
      route.push_back(route.back() + step_m * Vector2(std::cos(angle_rad), std::sin(angle_rad)));
      gone_m.push_back(length_m += (route.back() - route[route.size() - 2]).norm());
    }
    const std::vector<Vector2> way = beginning_of(route, {});
    RC_ASSERT(!way.empty() && way.front() == route.front());
    double before_m = 0.0;
    auto at = route.begin();
    for (std::size_t k = 1; k < way.size(); ++k) {
      at = std::find(at + 1, route.end(), way[k]);
      RC_ASSERT(at != route.end());
      const double here_m = gone_m[static_cast<std::size_t>(at - route.begin())];
      RC_ASSERT(here_m - before_m >= 0.3 - 1e-9 && here_m - before_m < 0.55);
      RC_ASSERT(here_m < 6.25);
      before_m = here_m;
    }
    RC_ASSERT(before_m > std::min(length_m, 6.0) - 0.55);
  }));
}

TEST(TeamView, TheBeginningIsAsLongAsTheParameterSays) {
  std::vector<Vector2> route;
  for (int k = 0; k <= 100; ++k) route.emplace_back(0.1 * k, 0.0);
  TeamViewParams params;
  params.way_m = 2.05;
  params.way_spacing_m = 0.95;
  const std::vector<Vector2> way = beginning_of(route, params);
  ASSERT_EQ(way.size(), 3U);
  EXPECT_NEAR(way[1].x(), 1.0, 1e-9);
  EXPECT_NEAR(way[2].x(), 2.0, 1e-9);
}

TEST(TeamView, OfNoRouteThereIsNoBeginning) { EXPECT_TRUE(beginning_of({}, {}).empty()); }

TEST(TeamView, AGoalOfTheTeamIsAtItsOpeningAndAGapWhereOneStands) {
  goals::Goal goal;
  goal.p_map = {1.0, 0.0};
  goal.opening = {3.0, 0.0};
  EXPECT_EQ(place_for_team(goal), goal.p_map);
  for (const goals::Side side :
       {goals::Side::kEast, goals::Side::kNorth, goals::Side::kWest, goals::Side::kSouth}) {
    goal.side = side;
    EXPECT_EQ(place_for_team(goal), goal.opening);
  }
}

TEST(TeamView, ClaimsAreThoseOfMatesThatCount) {
  team::StatusMessage claims = able_mate(3, {}), idle = able_mate(2, {}), home = able_mate(4, {});
  claims.claim = team::Bid{{4.0, 1.0}, 2.0};
  home.claim = claims.claim;
  home.duty = team::Duty::kOver;
  const team::Roster roster = roster_of({claims, idle, home});
  const Claims expected{{2, std::nullopt}, {3, Vector2(4.0, 1.0)}};
  EXPECT_EQ(claims_of_mates(roster, kToday), expected);
  EXPECT_TRUE(claims_of_mates(roster, after(11.0)).empty()) << "silent";
  EXPECT_TRUE(claims_of_mates(team::Roster{}, kToday).empty());
}

TEST(TeamView, ClaimsAreTheSameWhileTheyAreForTheSameGoals) {
  const Claims claims{{2, std::nullopt}, {3, Vector2(4.0, 1.0)}};
  const Claims moved{{2, std::nullopt}, {3, Vector2(5.4, 1.0)}},
      elsewhere{{2, std::nullopt}, {3, Vector2(5.6, 1.0)}};
  const Claims given_up{{2, std::nullopt}, {3, std::nullopt}},
      other{{2, std::nullopt}, {4, Vector2(4.0, 1.0)}};
  const Claims fewer{{2, std::nullopt}};
  const auto both_ways = [&](const Claims& b) {
    EXPECT_EQ(are_same_claims(claims, b), are_same_claims(b, claims));
    return are_same_claims(claims, b);
  };
  EXPECT_TRUE(both_ways(claims));
  EXPECT_TRUE(both_ways(moved));
  for (const Claims& b : {elsewhere, given_up, other, fewer, Claims{}}) EXPECT_FALSE(both_ways(b));
}

TEST(TeamView, MatesHaveGoalsThatTheyClaimOrBidFor) {
  team::StatusMessage claims = able_mate(3, {}), bids = able_mate(3, {}), over = able_mate(3, {});
  claims.claim = team::Bid{{4.0, 1.0}, 2.0};
  bids.bids = {*claims.claim};
  over.bids = bids.bids;
  over.duty = team::Duty::kOver;
  EXPECT_TRUE(mates_have_goals(roster_of({claims}), kToday));
  EXPECT_TRUE(mates_have_goals(roster_of({bids}), kToday));
  EXPECT_FALSE(mates_have_goals(roster_of({over}), kToday));
  EXPECT_FALSE(mates_have_goals(roster_of({able_mate(3, {})}), kToday));
  EXPECT_FALSE(mates_have_goals(roster_of({bids}), after(11.0)));
}

TEST(TeamView, AMateWasWhereItSaysUntilItIsMissing) {
  team::StatusMessage mate = able_mate(3, {});
  mate.visited = {{1.0, 1.0}, {5.0, 5.0}};
  mate.duty = team::Duty::kOver;  // what it saw counts, if nothing else does
  const team::Roster roster = roster_of({mate});
  EXPECT_TRUE(mate_was_at(roster, kToday, {5.5, 5.0}, 0.5));
  EXPECT_FALSE(mate_was_at(roster, kToday, {5.6, 5.0}, 0.5));
  EXPECT_TRUE(mate_was_at(roster, after(11.0), {5.0, 5.0}, 0.5)) << "in the shadow of a wall";
  EXPECT_FALSE(mate_was_at(roster, after(241.0), {5.0, 5.0}, 0.5)) << "what it saw may never arrive";
}

TEST(TeamView, AMateIsBehindInTheRobotsFrame) {
  EXPECT_TRUE(rc::check([] {
    const types::Se2 robot{0.1 * *rc::gen::inRange(-50, 50), 0.1 * *rc::gen::inRange(-50, 50),
                           0.1 * *rc::gen::inRange(-31, 32)};
    const Vector2 ahead(0.1 * *rc::gen::inRange(-20, 20) + 0.05, 0.1 * *rc::gen::inRange(-20, 20));
    const Vector2 at = robot * ahead;
    const team::Roster roster = roster_of({able_mate(3, {at.x(), at.y(), 0.0})});
    const bool behind = ahead.x() < 0.0 && ahead.norm() <= 1.5;
    if (std::abs(ahead.norm() - 1.5) > 1e-6)
      RC_ASSERT(is_mate_behind({5, roster, {}}, robot, kToday, {}) == behind);
    RC_ASSERT(!is_mate_behind({5, roster, {}}, robot, after(11.0), {}));
  }));
}

TEST(TeamView, ARobotSlowsForAMovingMateThatMayBeNearByNow) {
  team::StatusMessage mate = able_mate(7, {1.9, 0.0, 0.0});
  const auto slows = [&](double age_s) {
    const team::Roster roster = roster_of({mate});
    return slows_for_mate({5, roster, {}}, {}, after(age_s), {});
  };
  EXPECT_FALSE(slows(0.0)) << "it stands";
  mate.way_map = {{1.9, 0.0}, {3.0, 0.0}};
  EXPECT_TRUE(slows(0.0));
  mate.T_map_base = {3.0, 0.0, 0.0};
  EXPECT_FALSE(slows(0.0));
  EXPECT_TRUE(slows(2.0)) << "by now it may be 1.6 m away";
  mate.T_map_base = {-1.9, 0.0, 0.0};
  EXPECT_FALSE(slows(0.0)) << "behind";
}

TEST(TeamView, ARobotInAMatesWayHasToLetItPass) {
  team::StatusMessage mate = able_mate(7, {2.0, 0.0, 0.0});
  mate.way_map = {{2.0, 0.0}, {1.0, 0.0}, {0.0, 0.0}, {-1.0, 0.0}};
  const team::Roster roster = roster_of({mate});
  const TeamView team{5, roster, {}};
  const team::StatusMessage* const found = who_has_to_pass(team, {}, {}, kToday, {});
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->robot, 7U);
  const std::vector<Vector2> towards{{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}};
  EXPECT_EQ(who_has_to_pass(team, {}, towards, kToday, {}), nullptr)
      << "the mate with the higher number gives way";
  EXPECT_NE(who_has_to_pass({8, roster, {}}, {}, towards, kToday, {}), nullptr);
  EXPECT_EQ(who_has_to_pass(team, {0.0, 2.0, 0.0}, {}, kToday, {}), nullptr) << "beside its way";
  EXPECT_EQ(who_has_to_pass(team, {}, {}, after(11.0), {}), nullptr);
}

TEST(TeamView, HasMatesOnceOneWasHeardOf) {
  const team::Roster nobody, one = roster_of({able_mate(3, {})});
  EXPECT_FALSE((TeamView{5, nobody, {}}.has_mates()));
  EXPECT_TRUE((TeamView{5, one, {}}.has_mates()));
}

TEST(DecisionLog, KeepsTheLastOnesInTheirOrder) {
  DecisionLog log;
  for (int k = 0; k < 100; ++k) log.note(after(k), {1.0 * k, 0.0}, std::to_string(k));
  ASSERT_EQ(log.decisions.size(), DecisionLog::kKept);
  for (int k = 0; k < 64; ++k) {
    const Decision& decision = log.decisions[static_cast<std::size_t>(k)];
    EXPECT_EQ(decision.text, std::to_string(36 + k));
    EXPECT_EQ(decision.stamp, after(36 + k));
    EXPECT_EQ(decision.p_map, Vector2(36.0 + k, 0.0));
  }
}

}  // namespace
}  // namespace topo::exploration
