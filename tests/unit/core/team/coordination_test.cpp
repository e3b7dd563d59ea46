// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/coordination.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/unit/core/team/generators.hpp"

namespace topo::team {
namespace {

using types::Vector2;

double straight_m(const Vector2& a, const Vector2& b) { return (a - b).norm(); }
const MapView kAllInSight{[](const Vector2&, const Vector2&) { return true; }, straight_m};
const MapView kNoneInSight{[](const Vector2&, const Vector2&) { return false; }, straight_m};
constexpr std::array kRules{Rule::kAlone,   Rule::kClusters, Rule::kNoClusters, Rule::kInTurn,
                            Rule::kUtility, Rule::kMinPos,   Rule::kShares};

StatusMessage message(std::uint16_t robot, std::vector<Bid> bids, std::optional<Bid> claim = {}) {
  StatusMessage w;
  w.robot = robot;
  w.duty = Duty::kAble;
  w.bids = std::move(bids);
  w.claim = std::move(claim);
  return w;
}

std::vector<const StatusMessage*> others(const std::vector<StatusMessage>& team, std::size_t self) {
  std::vector<const StatusMessage*> mates;
  for (std::size_t i = 0; i < team.size(); ++i) {
    if (i != self) mates.push_back(&team[i]);
  }
  return mates;
}

/// Up to five robots that bid for some of the same goals.
std::vector<StatusMessage> arbitrary_team() {
  std::set<std::pair<double, double>> goals;
  for (const Vector2& p : testing::arbitrary_points(10)) goals.emplace(p.x(), p.y());
  std::vector<StatusMessage> team;
  for (int id = *rc::gen::inRange(0, 5); id >= 0; --id) {
    std::vector<Bid> bids;
    for (const auto& [x, y] : goals) {
      const double cost_m = testing::arbitrary_cost_m();
      if (cost_m < HUGE_VAL) bids.push_back({{x, y}, cost_m});
    }
    team.push_back(message(static_cast<std::uint16_t>(3 * id), testing::shuffled(bids)));
  }
  return team;
}

std::optional<Vector2> target_of(Rule rule, const std::vector<StatusMessage>& team, std::size_t self,
                                 const MapView& in_sight = kNoneInSight) {
  const auto bid = coordinate(rule, team[self], others(team, self), in_sight);
  if (!bid) return std::nullopt;
  return team[self].bids[*bid].p_map;
}

TEST(Coordinate, theOrderOfBidsAndMatesAndTheirRepetitionDoNotMatter) {
  EXPECT_TRUE(rc::check("a function of the messages", [] {
    const std::vector<StatusMessage> team = arbitrary_team();
    std::vector<StatusMessage> jumbled = testing::shuffled(team);
    for (StatusMessage& w : jumbled) w.bids = testing::shuffled(w.bids);
    for (const Rule rule : kRules) {
      for (std::size_t i = 0; i < team.size(); ++i) {
        const auto same = std::find_if(jumbled.begin(), jumbled.end(),
                                       [&](const StatusMessage& w) { return w.robot == team[i].robot; });
        const auto self = static_cast<std::size_t>(same - jumbled.begin());
        RC_ASSERT(target_of(rule, team, i, kAllInSight) == target_of(rule, jumbled, self, kAllInSight));
        std::vector<const StatusMessage*> twice = others(team, i);
        const auto once = twice;
        twice.insert(twice.end(), once.begin(), once.end());
        RC_ASSERT(coordinate(rule, team[i], twice, kAllInSight) ==
                  coordinate(rule, team[i], once, kAllInSight));
      }
    }
  }));
}

TEST(Coordinate, onlyTheOrderOfIdsMatters) {
  EXPECT_TRUE(rc::check("other numbers in the same order decide the same", [] {
    const std::vector<StatusMessage> team = arbitrary_team();
    std::vector<StatusMessage> renamed = team;
    std::uint16_t id = 1000;
    for (StatusMessage& w : renamed) w.robot = id = static_cast<std::uint16_t>(id - *rc::gen::inRange(1, 9));
    for (const Rule rule : kRules) {
      for (std::size_t i = 0; i < team.size(); ++i)
        RC_ASSERT(target_of(rule, team, i) == target_of(rule, renamed, i));
    }
  }));
}

TEST(Coordinate, whoHasTheSameWordsDecidesTheSame) {
  EXPECT_TRUE(rc::check("when all bid for all goals, no two go to one", [] {
    const std::vector<Vector2> points = testing::arbitrary_points(10);
    std::vector<StatusMessage> team;
    for (int id = *rc::gen::inRange(0, 5); id >= 0; --id) {
      std::vector<Bid> bids;
      for (const Vector2& p : points) bids.push_back({p, 1.0 * *rc::gen::inRange(1, 30)});
      team.push_back(message(static_cast<std::uint16_t>(id), bids));
    }
    for (const Rule rule : {Rule::kClusters, Rule::kNoClusters, Rule::kInTurn}) {
      std::set<std::pair<double, double>> taken;
      for (std::size_t i = 0; i < team.size(); ++i) {
        const auto target = target_of(rule, team, i);
        if (target) RC_ASSERT(taken.emplace(target->x(), target->y()).second);
      }
      RC_ASSERT(points.empty() == taken.empty());
    }
  }));
}

TEST(Coordinate, whoDoesNotBidForAllGoalsDecidesTheSameToo) {
  EXPECT_TRUE(rc::check("no two go to one, and nobody waits for a goal that nobody goes to", [] {
    const std::vector<StatusMessage> team = arbitrary_team();
    for (const Rule rule : {Rule::kNoClusters, Rule::kInTurn}) {
      std::set<std::pair<double, double>> taken;
      std::size_t going = 0;
      for (std::size_t i = 0; i < team.size(); ++i) {
        const auto target = target_of(rule, team, i);
        if (!target) continue;
        taken.emplace(target->x(), target->y());
        ++going;
      }
      RC_ASSERT(taken.size() == going);
      for (std::size_t i = 0; i < team.size(); ++i) {
        if (target_of(rule, team, i)) continue;
        for (const Bid& bid : team[i].bids) RC_ASSERT(taken.contains({bid.p_map.x(), bid.p_map.y()}));
      }
    }
  }));
}

TEST(Coordinate, aGoalIsNotLeftToAMateThatGoesElsewhere) {
  const Vector2 g(0.0, 0.0), h(9.0, 0.0);
  const std::vector<StatusMessage> team{message(0, {{g, 22.0}}), message(1, {{g, 20.0}, {h, 3.0}})};
  for (const Rule rule : {Rule::kClusters, Rule::kNoClusters}) {
    EXPECT_EQ(target_of(rule, team, 0), g);
    EXPECT_EQ(target_of(rule, team, 1), h);
  }
}

TEST(Coordinate, whatAMateComesPastSoonerIsLeftToIt) {
  const Vector2 near(0.0, 5.0), far(0.0, 9.0);  // along a corridor
  const auto second = [&](double way_m, const MapView& in_sight) {
    return target_of(Rule::kClusters,
                     {message(0, {{near, 4.0}, {far, 8.0}}), message(1, {{near, 6.0}, {far, way_m}})}, 1,
                     in_sight);
  };
  EXPECT_EQ(second(10.0, kAllInSight), std::nullopt) << "the first is there after 4 + 4 m";
  EXPECT_EQ(second(7.0, kAllInSight), far) << "the second is there before";
  EXPECT_EQ(second(10.0, kNoneInSight), far) << "whether a way leads from one to the other is not known";
}

TEST(Coordinate, aMateThatComesPastDoesNotLeaveTheGoalInTurn) {
  EXPECT_TRUE(rc::check("where anybody could go, somebody goes", [] {
    const std::vector<StatusMessage> team = arbitrary_team();
    for (const Rule rule : {Rule::kClusters, Rule::kNoClusters}) {
      bool wanted = false, going = false;
      for (std::size_t i = 0; i < team.size(); ++i) {
        wanted = wanted || !team[i].bids.empty();
        going = going || target_of(rule, team, i, kAllInSight).has_value();
      }
      RC_ASSERT(going == wanted);
    }
  }));
}

TEST(Coordinate, bidsThatAreNearlyForOneGoalAreForOne) {
  const std::vector<StatusMessage> team{message(0, {{{0.0, 0.0}, 5.0}}), message(1, {{{1.0, 0.0}, 6.0}})};
  EXPECT_EQ(target_of(Rule::kClusters, team, 0), Vector2(0.0, 0.0));
  EXPECT_EQ(target_of(Rule::kClusters, team, 1), std::nullopt);
}

TEST(Coordinate, aClaimCountsAsItWasMadeWhateverTheWayIsByNow) {
  const Vector2 p(3.0, 3.0);
  // Both have got nearer since, and each has heard of the other's way what it was before.
  const StatusMessage first = message(2, {{p, 3.0}}, Bid{p, 8.0}),
                      second = message(5, {{p, 2.5}}, Bid{p, 9.0});
  const StatusMessage first_before = message(2, {{p, 3.4}}, Bid{p, 8.0}),
                      second_before = message(5, {{p, 3.1}}, Bid{p, 9.0});
  const std::vector<const StatusMessage*> to_first{&second_before}, to_second{&first_before};
  EXPECT_TRUE(coordinate(Rule::kClusters, first, to_first, kAllInSight).has_value());
  EXPECT_FALSE(coordinate(Rule::kClusters, second, to_second, kAllInSight).has_value());
}

TEST(Coordinate, theChooserSeesItsClusterAndItsPresentGoal) {
  // Two clusters; robot 0 is nearer to the first one, and bound for a goal of the second.
  const std::vector<Bid> bids{{{0.0, 0.0}, 2.0}, {{0.0, 3.0}, 4.0}, {{30.0, 0.0}, 30.0}, {{30.0, 3.0}, 33.0}};
  const StatusMessage mate = message(1, {{{30.0, 0.0}, 1.0}, {{30.0, 3.0}, 3.0}}, Bid{{30.0, 0.0}, 1.5});
  const std::vector<const StatusMessage*> mates{&mate};
  const auto offered = [&](std::optional<Bid> claim) {
    std::vector<std::size_t> share;
    const Chooser last = [&](std::span<const std::size_t> s) {
      share.assign(s.begin(), s.end());
      return s.back();
    };
    const auto chosen = coordinate(Rule::kClusters, message(0, bids, claim), mates, kNoneInSight, last);
    EXPECT_EQ(chosen, share.back());
    return share;
  };
  EXPECT_EQ(offered({}), (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(offered(Bid{{30.0, 3.0}, 35.0}), (std::vector<std::size_t>{0, 1, 3}));
  EXPECT_EQ(offered(Bid{{30.0, 0.0}, 35.0}), (std::vector<std::size_t>{0, 1}))
      << "the mate's claim is better";
}

TEST(Coordinate, aClaimKeepsItsClusterThoughTheWayGrows) {
  const Bid goal{{0.0, 0.0}, 5.0}, beside{{2.0, 0.0}, 4.0}, far{{40.0, 0.0}, 40.0};
  const std::vector<StatusMessage> team{message(0, {goal, beside, far}),
                                        message(1, {{goal.p_map, 8.0}}, Bid{goal.p_map, 3.0})};
  EXPECT_EQ(target_of(Rule::kClusters, team, 0), far.p_map);
  EXPECT_EQ(target_of(Rule::kClusters, team, 1), goal.p_map);
}

TEST(Coordinate, aloneIsTheNearest) {
  const std::vector<StatusMessage> team{message(0, {{{0.0, 0.0}, 5.0}, {{9.0, 0.0}, 3.0}}),
                                        message(1, {{{9.0, 0.0}, 1.0}})};
  EXPECT_EQ(target_of(Rule::kAlone, team, 0), Vector2(9.0, 0.0));
  EXPECT_EQ(target_of(Rule::kClusters, team, 0), Vector2(0.0, 0.0));
}

TEST(Coordinate, aBetterClaimIsLeftToTheMate) {
  const Bid goal{{9.0, 0.0}, 5.0}, other{{0.0, 0.0}, 30.0};
  const auto choice = [&](double claim_m, std::uint16_t mate) {
    // The mate bids elsewhere by now, but still claims this goal.
    const StatusMessage w = message(mate, {{{50.0, 0.0}, 1.0}}, Bid{{9.5, 0.0}, claim_m});
    const std::vector<const StatusMessage*> mates{&w};
    return *coordinate(Rule::kNoClusters, message(4, {goal, other}), mates, kAllInSight);
  };
  EXPECT_EQ(choice(4.0, 7), 1U) << "the lower cost wins";
  EXPECT_EQ(choice(6.0, 7), 0U);
  EXPECT_EQ(choice(5.0, 3), 1U) << "of equal ones the lower id";
  EXPECT_EQ(choice(5.0, 7), 0U);
}

TEST(Coordinate, twoThatClaimOneGoalDoNotBothLeaveIt) {
  EXPECT_TRUE(rc::check("the better claim stays", [] {
    const Vector2 p(3.0, 3.0);
    const Bid a{p, 1.0 * *rc::gen::inRange(1, 4)}, b{p, 1.0 * *rc::gen::inRange(1, 4)};
    const std::vector<StatusMessage> team{message(2, {a}, a), message(5, {b}, b)};
    const bool first = target_of(Rule::kClusters, team, 0).has_value();
    const bool second = target_of(Rule::kClusters, team, 1).has_value();
    RC_ASSERT(first != second);
    RC_ASSERT(first == (a.cost_m <= b.cost_m));
  }));
}

TEST(Coordinate, robotsDoNotSwapWithoutGain) {
  // Each is on its way; costs have shifted a little in favour of swapping, and bids get a fifth off for that.
  const Vector2 p(10.0, 0.0), q(10.0, 8.0);
  const std::vector<StatusMessage> team{message(0, {{p, 0.8 * 10.0}, {q, 9.0}}, Bid{p, 8.0}),
                                        message(1, {{p, 9.0}, {q, 0.8 * 10.0}}, Bid{q, 8.0})};
  EXPECT_EQ(target_of(Rule::kClusters, team, 0), p);
  EXPECT_EQ(target_of(Rule::kClusters, team, 1), q);
}

TEST(Coordinate, nothingToBidForIsNothingToDo) {
  const std::vector<StatusMessage> team{message(0, {}), message(1, {{{9.0, 0.0}, 1.0}})};
  for (const Rule rule : kRules) EXPECT_EQ(target_of(rule, team, 0), std::nullopt);
}

/// What a robot is offered of its bids under Rule::kShares.
std::vector<std::size_t> offered(const StatusMessage& self, const StatusMessage& mate,
                                 const TravelBetween& between_m = straight_m) {
  std::vector<std::size_t> share;
  const Chooser first = [&](std::span<const std::size_t> s) {
    share.assign(s.begin(), s.end());
    return s.front();
  };
  const std::vector<const StatusMessage*> mates{&mate};
  (void)coordinate(Rule::kShares, self, mates, {kNoneInSight.in_sight, between_m}, first);
  return share;
}

using Share = std::vector<std::size_t>;

TEST(Shares, aGoalIsOfWhoIsOrWillBeNearest) {
  const Vector2 here(0.0, 0.0), there(30.0, 0.0), beyond(34.0, 0.0);
  const std::vector<Bid> bids{{here, 2.0}, {there, 30.0}, {beyond, 34.0}};
  const StatusMessage mate = message(1, {{here, 9.0}, {there, 25.0}, {beyond, 29.0}}, Bid{there, 25.0});
  EXPECT_EQ(offered(message(0, bids), mate), Share{0}) << "what lies behind the mate's goal is the mate's";
  EXPECT_EQ(offered(mate, message(0, bids)), (Share{1, 2}));
}

TEST(Shares, aGapBesideTheRobotIsItsOwn) {
  const Vector2 gap(20.0, 2.0), mates(20.0, 6.0);
  const StatusMessage self = message(3, {{gap, 2.0}, {mates, 8.0}}, {});
  const StatusMessage mate = message(1, {{gap, 19.0}, {mates, 15.0}}, Bid{mates, 15.0});
  EXPECT_EQ(offered(self, mate), Share{0}) << "though it lies beside the mate's goal";
}

TEST(Shares, wallsDivideWhatIsSideBySide) {
  const Vector2 mates(10.0, 0.0), next_door(12.0, 0.0);
  const StatusMessage self = message(3, {{mates, 30.0}, {next_door, 12.0}});
  const StatusMessage mate = message(1, {{mates, 3.0}, {next_door, 25.0}}, Bid{mates, 3.0});
  EXPECT_EQ(offered(self, mate, [](const Vector2&, const Vector2&) { return 22.0; }), Share{1});
  EXPECT_EQ(offered(mate, self), (Share{0, 1})) << "without the wall it is the mate's";
}

TEST(Shares, inAnEntranceHallTheRobotsPart) {
  // Both stand together; corridors lead to either side, gaps are beside the first goal.
  const Vector2 west(-12.0, 0.0), gap(-11.0, 3.0), east(14.0, 0.0);
  const std::vector<Bid> bids{{west, 12.0}, {gap, 11.5}, {east, 14.0}};
  const StatusMessage first = message(0, bids, Bid{west, 12.0});
  EXPECT_EQ(offered(first, message(1, bids)), (Share{0, 1, 2})) << "of equal ways the lower id";
  EXPECT_EQ(offered(message(1, bids), first), Share{2}) << "where the first is not going";
}

TEST(Shares, whatIsSharedHoldsWhileBothDrive) {
  const Vector2 west(-20.0, 0.0), east(20.0, 0.0);
  for (double driven_m = 0.0; driven_m < 18.0; driven_m += 3.0) {
    const auto bid = [&](const Vector2& goal, double x_m) {
      return Bid{goal, (goal - Vector2(x_m, 0.0)).norm()};
    };
    const StatusMessage one = message(0, {bid(west, -driven_m), bid(east, -driven_m)}, Bid{west, 20.0});
    const StatusMessage other = message(1, {bid(west, driven_m), bid(east, driven_m)}, Bid{east, 20.0});
    EXPECT_EQ(offered(one, other).front(), 0U) << driven_m;
    EXPECT_EQ(offered(other, one), Share{1}) << driven_m;
  }
}

TEST(Shares, whoHasNoneHelpsWhereItIsLeastBehind) {
  const Vector2 mates(3.0, 0.0), near(6.0, 0.0), far(30.0, 0.0);
  const StatusMessage mate = message(1, {{mates, 1.0}, {near, 4.0}, {far, 28.0}}, Bid{mates, 1.0});
  EXPECT_EQ(offered(message(3, {{mates, 20.0}, {near, 23.0}, {far, 40.0}}), mate), Share{2});
  EXPECT_EQ(offered(message(3, {{mates, 20.0}}), mate), Share{}) << "that is the mate's";
}

}  // namespace
}  // namespace topo::team
