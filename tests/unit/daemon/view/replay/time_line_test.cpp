// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/replay/time_line.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace topo::daemon {
namespace {

TimeLine line_of(double length_s) {
  TimeLine line;
  line.set_length(length_s);
  return line;
}

RC_GTEST_PROP(TimeLine, GoesAsFastAsItIsTold, (bool playing)) {
  const double speed = *rc::gen::inRange(1, 51), seconds = *rc::gen::inRange(0, 100),
               from = *rc::gen::inRange(0, 500);
  TimeLine line = line_of(1000.0);
  RC_ASSERT(line.take({{"speed", speed}, {"playing", playing}, {"position_s", from}}).has_value());
  line.advance(seconds);
  RC_ASSERT(line.position_s() == (playing ? std::min(1000.0, from + speed * seconds) : from));
}

TEST(TimeLine, BeginsAtTheBeginningAndPlays) {
  TimeLine line = line_of(10.0);
  EXPECT_EQ(line.json(), (Json{{"position_s", 0.0}, {"length_s", 10.0}, {"speed", 1.0}, {"playing", true}}));
  line.advance(4.0);
  EXPECT_EQ(line.position_s(), 4.0);
}

TEST(TimeLine, PlayAtTheEndBeginsAnew) {
  TimeLine line = line_of(10.0);
  line.advance(20.0);
  EXPECT_EQ(line.position_s(), 10.0);
  ASSERT_TRUE(line.take({{"playing", true}}));
  EXPECT_EQ(line.position_s(), 0.0);
}

TEST(TimeLine, GoesOnWhenTheStoryBecomesLonger) {
  TimeLine line = line_of(10.0);
  line.advance(20.0);
  line.set_length(12.0);
  line.advance(1.0);
  EXPECT_EQ(line.position_s(), 11.0);
}

TEST(TimeLine, AWishBeyondTheEndIsTheEnd) {
  TimeLine line = line_of(10.0);
  for (const auto& [wished, got] : {std::pair{-5.0, 0.0}, {1e300, 10.0}, {7.0, 7.0}}) {
    ASSERT_TRUE(line.take({{"position_s", wished}}));
    EXPECT_EQ(line.position_s(), got);
  }
}

TEST(TimeLine, AWrongWishChangesNothing) {
  TimeLine line = line_of(10.0);
  const Json before = line.json();
  for (const Json& wish : {Json{{"position_s", 5}, {"speed", 0.5}}, Json{{"position_s", 5}, {"speed", 51}},
                           Json{{"position_s", 5}, {"speed", "fast"}}, Json{{"position_s", "5"}},
                           Json{{"position_s", nullptr}}, Json{{"position_s", 5}, {"playing", 1}}}) {
    const auto taken = line.take(wish);
    ASSERT_FALSE(taken.has_value()) << wish;
    EXPECT_NE(taken.error().message.find("expected"), std::string::npos) << taken.error().message;
    EXPECT_EQ(line.json(), before);
  }
}

}  // namespace
}  // namespace topo::daemon
