// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/control/turns.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <string>

namespace topo::daemon {
namespace {

using namespace std::chrono_literals;

const Standing kCommander{true, 1000}, kLooker{false, 2000}, kOtherLooker{false, 3000};

class TurnsTest : public ::testing::Test {
 protected:
  /// "client:line" of the next turn, answered at once; empty when there is none.
  std::string next() {
    const auto turn = turns.next(now);
    if (!turn) return {};
    turns.answered(turn->standing.may_command);
    return std::to_string(turn->client) + ":" + turn->line;
  }
  Quota quota;
  Turns turns{quota};
  types::Stamp now{100s};
};

TEST_F(TurnsTest, OneRequestAClientATurn) {
  turns.join(1, kCommander);
  turns.join(2, kCommander);
  for (int i = 0; i < 3; ++i) turns.add(1, "a", false);
  turns.add(2, "b", false);
  EXPECT_EQ(next(), "1:a");
  EXPECT_EQ(next(), "2:b");
  EXPECT_EQ(next(), "1:a");
  EXPECT_EQ(next(), "1:a");
  EXPECT_EQ(next(), "");
  EXPECT_FALSE(turns.next_at(now));
}

TEST_F(TurnsTest, StopThenCommandersThenOthers) {
  turns.join(1, kLooker);
  turns.join(2, kCommander);
  turns.join(3, kOtherLooker);
  turns.add(1, "status", false);
  turns.add(2, "start", false);
  turns.add(3, "status", false);
  turns.add(3, "estop", true);
  EXPECT_EQ(next(), "3:estop");
  EXPECT_EQ(next(), "2:start");
  EXPECT_EQ(next(), "1:status");
  EXPECT_EQ(next(), "3:status");
}

TEST_F(TurnsTest, WhatWaitedDuringAStopIsOvertaken) {
  turns.join(1, kCommander);
  turns.join(2, kLooker);
  turns.add(1, "clear_estop", false);
  turns.add(2, "estop", true);
  EXPECT_EQ(next(), "2:estop");
  turns.add(1, "clear_estop", false);
  EXPECT_TRUE(turns.next(now)->overtaken);
  EXPECT_FALSE(turns.next(now)->overtaken);
}

TEST_F(TurnsTest, QuotaIsOfTheUserAndComesBack) {
  turns.join(1, kLooker);
  turns.join(2, kLooker);  // a second connection brings no second quota
  turns.join(3, kOtherLooker);
  for (int i = 0; i < quota.request_burst; ++i) {
    turns.add(1, "goals", false);
    turns.add(2, "goals", false);
  }
  turns.add(3, "goals", false);
  int mine = 0, others = 0;
  for (std::string served = next(); !served.empty(); served = next()) ++(served[0] == '3' ? others : mine);
  EXPECT_EQ(mine, quota.request_burst);
  EXPECT_EQ(others, 1);
  EXPECT_EQ(turns.next_at(now), now + quota.request_period);
  now += quota.request_period;
  EXPECT_NE(next(), "");
  EXPECT_EQ(next(), "");
}

TEST_F(TurnsTest, QuotaOutlivesTheConnection) {
  turns.join(1, kLooker);
  for (int i = 0; i < quota.request_burst; ++i) turns.add(1, "goals", false);
  while (!next().empty()) {
  }
  turns.leave(1);
  turns.join(2, kLooker);
  turns.add(2, "goals", false);
  EXPECT_EQ(next(), "");
}

TEST_F(TurnsTest, StopsHaveNoQuota) {
  turns.join(1, kLooker);
  for (int i = 0; i < 10 * quota.request_burst; ++i) turns.add(1, "estop", true);
  int stops = 0;
  while (!next().empty()) ++stops;
  EXPECT_EQ(stops, 10 * quota.request_burst);
}

TEST_F(TurnsTest, LateAnswersToOthersAreFew) {
  turns.join(1, kLooker);
  turns.join(2, kCommander);
  for (int i = 0; i < 3; ++i) turns.add(1, "doctor", false);
  ASSERT_TRUE(turns.next(now) && turns.next(now));
  EXPECT_FALSE(turns.next(now));
  EXPECT_FALSE(turns.next_at(now));
  turns.add(2, "doctor", false);
  turns.add(1, "estop", true);
  EXPECT_EQ(next(), "1:estop");
  EXPECT_EQ(next(), "2:doctor");
  turns.answered(false);
  EXPECT_EQ(next(), "1:doctor");
}

TEST_F(TurnsTest, WhoHasLeftIsStillObeyed) {
  turns.join(1, kCommander);
  turns.join(2, kLooker);
  turns.add(1, "stop", false);
  turns.add(2, "status", false);
  turns.add(2, "estop", true);
  turns.leave(1);
  turns.leave(2);
  EXPECT_EQ(next(), "2:estop");
  EXPECT_EQ(next(), "1:stop");
  EXPECT_EQ(next(), "");
}

/// Whatever comes in whatever order: from the arrival of an e-stop on, at most two other requests are served
/// before it or another client's, and nothing that waits within its quota is forgotten.
void at_most_two_others_before_a_stop() {
  Turns turns{Quota{}};
  const types::Stamp now{100s};
  for (std::uint64_t client = 0; client < 8; ++client)
    turns.join(client, client % 2 == 0 ? kCommander : kLooker);
  int stops = 0, since = 0;
  const auto acts = *rc::gen::container<std::vector<int>>(300, rc::gen::inRange(0, 40));
  for (const int act : acts) {
    const auto client = static_cast<std::uint64_t>(act % 8);
    if (act < 8) {
      if (stops++ == 0) since = 0;
      turns.add(client, "estop", true);
    } else if (act < 24) {
      turns.add(client, "goals", false);
    } else if (const auto turn = turns.next(now)) {
      turns.answered(turn->standing.may_command);
      const bool stop = turn->line == "estop";
      stops -= stop ? 1 : 0;
      since = stop ? 0 : since + 1;
      RC_ASSERT(stops == 0 || since <= 2);
    } else {
      RC_ASSERT(stops == 0);
    }
  }
}

TEST(TurnsProperty, AtMostTwoOthersBeforeAStop) { EXPECT_TRUE(rc::check(&at_most_two_others_before_a_stop)); }

}  // namespace
}  // namespace topo::daemon
