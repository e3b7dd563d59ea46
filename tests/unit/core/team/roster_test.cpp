// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/roster.hpp"

#include <gtest/gtest.h>

#include "tests/unit/core/team/clock.hpp"
#include "tests/unit/core/team/generators.hpp"

namespace topo::team {
namespace {

using testing::at;

StatusMessage told(std::uint16_t robot, std::uint64_t sequence, double x_m = 0.0, Duty duty = Duty::kAble) {
  StatusMessage w;
  w.robot = robot;
  w.sequence = sequence;
  w.T_map_base = {x_m, 0.0, 0.0};
  w.duty = duty;
  return w;
}

StatusMessage claiming(std::uint16_t robot, std::uint64_t sequence, double x_m) {
  StatusMessage w = told(robot, sequence, x_m);
  w.claim = Bid{{50.0, 0.0}, 50.0};
  return w;
}

std::vector<std::pair<std::uint16_t, std::uint64_t>> names(
    const std::vector<const StatusMessage*>& messages) {
  std::vector<std::pair<std::uint16_t, std::uint64_t>> out;
  for (const StatusMessage* w : messages) out.emplace_back(w->robot, w->sequence);
  return out;
}

TEST(Roster, keepsTheNewestOfEachWhateverOrderWordsComeIn) {
  EXPECT_TRUE(rc::check("any order, any repetition", [] {
    std::vector<StatusMessage> messages;
    for (std::uint16_t robot = 1; robot < 4; ++robot) {
      for (std::uint64_t n = 1; n <= 4; ++n) {
        messages.push_back(told(robot, n));
        if (*rc::gen::arbitrary<bool>()) messages.push_back(told(robot, n));
      }
    }
    Roster roster;
    for (const StatusMessage& w : testing::shuffled(messages)) (void)roster.take(w, at(0.0));
    const std::vector<std::pair<std::uint16_t, std::uint64_t>> newest{{1, 4}, {2, 4}, {3, 4}};
    RC_ASSERT(names(roster.heard(at(1.0))) == newest);
    RC_ASSERT(names(roster.counted(at(1.0))) == newest);
  }));
}

TEST(Roster, aRepeatedWordDoesNotMakeASilentRobotHeard) {
  Roster roster;
  EXPECT_TRUE(roster.take(told(1, 5), at(0.0)));
  EXPECT_FALSE(roster.take(told(1, 5), at(9.0)));
  EXPECT_FALSE(roster.take(told(1, 4), at(9.0)));
  EXPECT_EQ(roster.heard(at(10.0)).size(), 1U);
  EXPECT_TRUE(roster.heard(at(10.1)).empty());
  EXPECT_TRUE(roster.take(told(1, 6), at(11.0)));
  EXPECT_EQ(roster.counted(at(11.0)).size(), 1U) << "it is back";
}

TEST(Roster, hearsARobotThatWasStartedAgainAndCountsFromOne) {
  Roster roster;
  (void)roster.take(claiming(1, 500, 0.0), at(0.0));
  EXPECT_FALSE(roster.take(told(1, 1, 7.0), at(9.0))) << "it may be a message that comes late";
  EXPECT_TRUE(roster.take(told(1, 2, 7.0), at(10.5)));
  EXPECT_EQ(names(roster.counted(at(10.5))), (std::vector<std::pair<std::uint16_t, std::uint64_t>>{{1, 2}}));
  EXPECT_TRUE(roster.take(told(1, 3, 7.0), at(11.0)));
  EXPECT_FALSE(roster.take(told(1, 3, 7.0), at(22.0))) << "a repeated message";
}

TEST(Roster, onlyWhoCanGoAndWasJustHeardIsGoing) {
  Roster roster;
  (void)roster.take(told(1, 1, 1.0), at(0.0));
  (void)roster.take(told(2, 1, 2.0, Duty::kUnable), at(0.0));
  (void)roster.take(told(3, 1, 3.0, Duty::kOver), at(0.0));
  EXPECT_EQ(roster.going_at(at(2.0)), (std::vector<types::Vector2>{{1.0, 0.0}}));
  EXPECT_TRUE(roster.going_at(at(2.1)).empty());
}

TEST(Roster, aLostRobotFreesItsGoalAndIsStillSeen) {
  Roster roster;
  (void)roster.take(told(1, 1), at(0.0));
  (void)roster.take(told(1, 2, 0.0, Duty::kUnable), at(2.0));
  (void)roster.take(told(1, 3, 0.0, Duty::kUnable), at(9.0));
  EXPECT_EQ(roster.counted(at(9.9)).size(), 1U);
  EXPECT_TRUE(roster.counted(at(10.1)).empty());
  EXPECT_EQ(roster.heard(at(10.1)).size(), 1U);
  (void)roster.take(told(1, 4), at(11.0));
  EXPECT_EQ(roster.counted(at(11.0)).size(), 1U);
}

TEST(Roster, aRobotThatClaimsAGoalAndDoesNotGetOnFreesIt) {
  Roster roster;
  std::uint64_t n = 0;
  for (double s = 0.0; s <= 40.0; s += 1.0) (void)roster.take(claiming(1, ++n, 0.01 * s), at(s));
  EXPECT_TRUE(roster.counted(at(40.0)).empty());
  EXPECT_EQ(roster.heard(at(40.0)).size(), 1U);
  (void)roster.take(claiming(1, ++n, 2.0), at(41.0));
  EXPECT_EQ(roster.counted(at(41.0)).size(), 1U) << "it got on";
  Roster patient;
  for (double s = 0.0; s <= 40.0; s += 1.0) (void)patient.take(told(1, ++n), at(s));
  EXPECT_EQ(patient.counted(at(40.0)).size(), 1U) << "who waits without a goal is not stuck";
}

TEST(Roster, allAreHomeWhenNobodyThatIsHeardIsOut) {
  Roster roster;
  EXPECT_TRUE(roster.all_home(at(0.0))) << "a robot alone";
  (void)roster.take(told(1, 1, 0.0, Duty::kOver), at(0.0));
  (void)roster.take(told(2, 1), at(0.0));
  EXPECT_FALSE(roster.all_home(at(1.0)));
  EXPECT_EQ(names(roster.counted(at(1.0))), (std::vector<std::pair<std::uint16_t, std::uint64_t>>{{2, 1}}));
  EXPECT_FALSE(roster.all_home(at(11.0))) << "the other is silent, and may want past";
  EXPECT_TRUE(roster.all_home(at(241.0))) << "the other is missing";
}

TEST(Roster, onlyARobotWaitingAtHomeCanMakeWay) {
  Roster roster;
  StatusMessage message;
  message.robot = 3;
  message.sequence = 1;
  message.duty = Duty::kOver;
  message.T_map_base = {5.0, 0.0, 0.0};
  (void)roster.take(message, at(0.0));
  EXPECT_TRUE(roster.going_at(at(1.0)).empty());
  ++message.sequence;
  message.home = types::Vector2(0.0, 0.0);
  (void)roster.take(message, at(1.0));
  EXPECT_TRUE(roster.going_at(at(1.0)).empty()) << "over on its way";
  ++message.sequence;
  message.T_map_base = {0.3, 0.0, 0.0};
  (void)roster.take(message, at(2.0));
  EXPECT_EQ(roster.going_at(at(2.5)).size(), 1U);
  EXPECT_TRUE(roster.going_at(at(5.0)).empty()) << "heard of too long ago";
}

}  // namespace
}  // namespace topo::team
