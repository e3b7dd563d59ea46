// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/round_trip.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <random>

namespace topo::pioneer {
namespace {

using std::chrono::milliseconds;

/// A base that answers after a delay, on a line that loses packets.
struct Line {
  types::Duration delay = milliseconds(60);
  double loss = 0.0;
  RoundTrip trip;
  types::Stamp now = types::stamp_from_seconds(50.0);
  std::deque<types::Stamp> answers;
  std::mt19937 random{9};
  types::Duration longest{};
  int asked = 0;

  void run(double seconds) {
    const types::Stamp end = now + types::from_seconds(seconds);
    for (; now < end; now += milliseconds(10)) {
      while (!answers.empty() && answers.front() <= now) {
        trip.answered(answers.front());
        answers.pop_front();
      }
      trip.expire(now);
      if (trip.is_due(now)) {
        trip.asked(now);
        ++asked;
        if (std::uniform_real_distribution<double>(0.0, 1.0)(random) >= loss) answers.push_back(now + delay);
      }
      longest = std::max(longest, trip.trip());
    }
  }
};

TEST(RoundTrip, isThatOfAGoodLine) {
  Line line;
  line.run(10.0);
  EXPECT_NEAR(types::to_seconds(line.trip.trip()), 0.06, 0.011);
  EXPECT_GE(line.asked, 19);
  EXPECT_LE(line.asked, 21);
}

TEST(RoundTrip, aDelayIsKnownByTheNextAnswer) {
  for (const int delay_ms : {450, 600, 1500, 2500, 6000}) {
    Line line;
    line.run(10.0);
    line.delay = milliseconds(delay_ms);
    const types::Stamp begin = line.now;
    while (line.trip.trip() <= milliseconds(400) && line.now - begin < milliseconds(20000)) line.run(0.01);
    // Beyond the time after which a request is lost, three of them tell.
    const double known_s = delay_ms < 3000 ? 1e-3 * delay_ms + 1.1 : 11.0;
    EXPECT_LT(types::to_seconds(line.now - begin), known_s) << delay_ms;
    line.run(5.0);
    EXPECT_GT(line.trip.trip(), milliseconds(400)) << "it stays known";
    line.delay = milliseconds(60);
    line.run(12.0);
    EXPECT_LT(line.trip.trip(), milliseconds(400)) << "and passes";
  }
}

TEST(RoundTrip, itBeginsWhenTheRequestHasLeft) {
  RoundTrip trip;
  const types::Stamp begin = types::stamp_from_seconds(50.0);
  trip.asked(begin);
  trip.left(begin - milliseconds(500));  // of the one before
  trip.left(begin + milliseconds(450));
  trip.answered(begin + milliseconds(500));
  EXPECT_EQ(trip.trip(), milliseconds(50));
}

TEST(RoundTrip, anAnswerThatMayHaveComeAtOnceIsOne) {
  RoundTrip trip;
  const types::Stamp begin = types::stamp_from_seconds(50.0);
  trip.asked(begin);
  trip.answered(begin - milliseconds(20));  // when the host looked last
  EXPECT_GT(trip.trip(), types::Duration{}) << "0 is a base that never answered";
  EXPECT_LT(trip.trip(), milliseconds(1));
}

TEST(RoundTrip, lostPacketsAreNoDelay) {
  Line line;
  line.loss = 0.02;
  line.run(1800.0);
  EXPECT_LE(line.longest, milliseconds(400));
}

TEST(RoundTrip, aBaseThatNeverAnswersIsNotAskedForEver) {
  Line line;
  line.loss = 1.0;
  line.run(60.0);
  EXPECT_EQ(line.longest, types::Duration{});
  EXPECT_LE(line.asked, 10);
}

}  // namespace
}  // namespace topo::pioneer
