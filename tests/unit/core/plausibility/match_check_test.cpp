// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/plausibility/match_check.hpp"

#include <gtest/gtest.h>

#include <random>

namespace topo::plausibility {
namespace {

/// Drives for some seconds at 40 scans a second; `seen` is the motion that scan matching finds for a step.
template <class Seen>
bool disagrees_after(double seconds, const types::Se2& step, Seen seen) {
  MatchCheck check;
  MatchedMotion motion;
  bool disagreed = false;
  types::Se2 odom;
  for (int i = 1; i <= static_cast<int>(40.0 * seconds); ++i) {
    odom = odom * step;
    motion = after_scan(motion, types::stamp_from_seconds(5.0 + 0.025 * i), seen(step), odom, true);
    disagreed = check.judge(motion) || disagreed;
  }
  return disagreed;
}

const types::Se2 kAhead{0.0175, 0.0, 0.0};  // 0.7 m/s
const types::Se2 kTurn{0.0, 0.0, 0.025};    // 1 rad/s
const types::Se2 kArc{0.01, 0.0, 0.02};

TEST(MatchCheck, believesMatchesWithTheirNoise) {
  for (const types::Se2& step : {kAhead, kTurn, kArc, types::Se2{}}) {
    std::mt19937 random(7);
    std::normal_distribution<double> m(0.0, 0.005), rad(0.0, 0.003);
    EXPECT_FALSE(disagrees_after(60.0, step, [&](const types::Se2& s) {
      return s * types::Se2{m(random), m(random), rad(random)};
    }));
  }
}

TEST(MatchCheck, believesWheelsThatErrByATenth) {
  EXPECT_FALSE(disagrees_after(30.0, kAhead, [](const types::Se2&) {
    return types::Se2{0.9 * 0.0175, 0.0, 0.0};
  }));
  EXPECT_FALSE(disagrees_after(30.0, kTurn, [](const types::Se2&) {
    return types::Se2{0.0, 0.0, 0.9 * 0.025};
  }));
}

TEST(MatchCheck, doubtsAScannerOfAnotherRobot) {
  const auto stands = [](const types::Se2&) { return types::Se2{}; };
  EXPECT_TRUE(disagrees_after(2.2, kAhead, stands));
  EXPECT_TRUE(disagrees_after(2.2, kTurn, stands));
}

TEST(MatchCheck, doubtsAScannerUpsideDown) {
  EXPECT_TRUE(disagrees_after(2.2, kTurn, [](const types::Se2& s) { return s.inverse(); }));
}

TEST(MatchCheck, doubtsAScannerThatLooksBackwards) {
  EXPECT_TRUE(disagrees_after(2.2, kAhead, [](const types::Se2& s) { return s.inverse(); }));
}

TEST(MatchCheck, doubtsAMotionThatNoWheelMeasured) {
  EXPECT_TRUE(disagrees_after(2.2, {}, [](const types::Se2&) { return kAhead; }));
}

TEST(MatchCheck, judgesNothingWhileNothingMatches) {
  MatchCheck check;
  MatchedMotion motion;
  types::Se2 odom;
  for (int i = 1; i <= 400; ++i) {
    odom = odom * kAhead;
    // Lost and found again by turns; the jump comes with the scan that is found.
    const bool matched = i % 10 == 0;
    const types::Se2 seen = matched ? types::Se2{0.5, 0.2, 0.3} : kAhead;
    motion = after_scan(motion, types::stamp_from_seconds(5.0 + 0.025 * i), seen, odom, matched);
    ASSERT_FALSE(check.judge(motion));
  }
}

TEST(MatchCheck, agreesAgainAfterAWindowThatAgrees) {
  MatchCheck check;
  MatchedMotion motion;
  types::Se2 odom;
  const auto drive = [&](int scans, const types::Se2& step, const types::Se2& seen) {
    for (int i = 0; i < scans; ++i) {
      odom = odom * step;
      motion = after_scan(motion, motion.stamp + std::chrono::milliseconds(25), seen, odom, true);
      check.judge(motion);
    }
  };
  motion.stamp = types::stamp_from_seconds(5.0);
  drive(100, kAhead, {});
  ASSERT_TRUE(check.disagrees());
  drive(90, {}, {});
  EXPECT_FALSE(check.disagrees());
}

}  // namespace
}  // namespace topo::plausibility
