// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/plausibility/obedience.hpp"

#include <gtest/gtest.h>

#include "tests/unit/core/plausibility/driven_base.hpp"

namespace topo::plausibility {
namespace {

using std::chrono::milliseconds;
using testing::DrivenBase;
using testing::Ramp;
using types::Twist2;

struct Drive {
  explicit Drive(std::uint32_t seed = 1) : base(seed) {}

  /// Returns false as soon as `until` says so.
  template <class Until>
  bool run(double seconds, const Twist2& wanted, Until until, bool ramped = true) {
    const types::Stamp end = base.now + types::from_seconds(seconds);
    while (base.now < end) {
      if (!ramped) ramp.stop();
      const Twist2 commanded = ramped ? ramp.towards(wanted) : wanted;
      const bool heard = base.step(commanded);
      commands.add(base.now, base.state.motors_enabled ? commanded : Twist2{}, {});
      if (!heard) continue;
      opinion = obedience.judge(commands, base.state, {});
      longest = std::max(longest, opinion.lag);
      if (until(opinion)) return false;
    }
    return true;
  }
  bool trusts(double seconds, const Twist2& wanted, bool ramped = true) {
    return run(
        seconds, wanted, [](const ObedienceOpinion& o) { return o.disobeys || o.late; }, ramped);
  }

  DrivenBase base;
  Ramp ramp;
  CommandHistory commands;
  Obedience obedience;
  ObedienceOpinion opinion;
  types::Duration longest{};
};

TEST(Obedience, believesABaseThatFollowsWithItsLag) {
  for (const int lag_ms : {0, 50, 100, 150, 200}) {
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
      Drive drive(seed);
      drive.base.lag = milliseconds(lag_ms);
      std::mt19937 random(seed);
      std::uniform_real_distribution<double> v(-0.1, 0.7), omega(-1.4, 1.4), time(0.3, 4.0);
      for (int leg = 0; leg < 60; ++leg)
        ASSERT_TRUE(drive.trusts(time(random), {v(random), omega(random)}))
            << lag_ms << " " << seed << " " << leg;
      EXPECT_NEAR(types::to_seconds(drive.opinion.lag), 1e-3 * lag_ms, 0.11);
    }
  }
}

TEST(Obedience, believesAnEmergencyStop) {
  Drive drive;
  drive.base.braking_mps2 = 2.0;
  ASSERT_TRUE(drive.trusts(6.0, {0.7, 0.0}));
  EXPECT_TRUE(drive.trusts(6.0, {}, false));
}

TEST(Obedience, believesABaseThatIsBlocked) {
  Drive drive;
  drive.base.obeys = false;  // the wheels do not turn, whatever is commanded
  EXPECT_TRUE(drive.run(10.0, {0.5, 0.0}, [](const ObedienceOpinion& o) { return o.disobeys; }));
}

TEST(Obedience, doubtsABaseThatSwallowsStops) {
  for (const double speed : {0.25, 0.4, 0.7}) {
    Drive drive;
    ASSERT_TRUE(drive.trusts(6.0, {speed, 0.0}));
    drive.base.obeys = false;
    const types::Stamp begin = drive.base.now;
    EXPECT_FALSE(drive.run(5.0, {}, [](const ObedienceOpinion& o) { return o.disobeys; })) << speed;
    const double braking_s = speed / (0.5 * 0.5);
    EXPECT_LT(types::to_seconds(drive.base.now - begin), 0.3 + 0.3 + 0.15 + braking_s);
  }
}

TEST(Obedience, doubtsAStandingBaseThatDrivesOff) {
  Drive drive;
  ASSERT_TRUE(drive.trusts(2.0, {}));
  drive.base.obeys = false;
  const types::Stamp begin = drive.base.now;
  EXPECT_FALSE(drive.run(3.0, {}, [&](const ObedienceOpinion& o) {
    drive.base.push(0.4);
    return o.disobeys;
  }));
  EXPECT_LE(drive.base.now - begin, milliseconds(500));
}

TEST(Obedience, letsHandsMoveARobotWithoutMotors) {
  Drive drive;
  drive.base.state.motors_enabled = false;
  drive.base.obeys = false;
  EXPECT_TRUE(drive.run(3.0, {}, [&](const ObedienceOpinion& o) {
    drive.base.push(0.5);
    return o.disobeys || o.late;
  }));
}

TEST(Obedience, measuresLateCommands) {
  for (const int lag_ms : {450, 800, 1500, 1900}) {
    Drive drive;
    drive.base.lag = milliseconds(lag_ms);
    EXPECT_FALSE(drive.run(8.0, {0.7, 0.0}, [](const ObedienceOpinion& o) { return o.late; })) << lag_ms;
    EXPECT_LT(drive.base.v_mps(), 0.45) << lag_ms;
    EXPECT_GT(drive.opinion.lag, milliseconds(300)) << lag_ms;
    EXPECT_LT(drive.opinion.lag, milliseconds(lag_ms + 150)) << lag_ms;
    // The delayed motion is no disobedience; it tells the whole lag.
    EXPECT_TRUE(drive.run(
        4.0, {}, [](const ObedienceOpinion& o) { return o.disobeys; }, false))
        << lag_ms;
    EXPECT_NEAR(types::to_seconds(drive.opinion.lag), 1e-3 * lag_ms, 0.25) << lag_ms;
  }
}

TEST(Obedience, aLateAnswerIsNoDisobedience) {
  Drive drive;
  drive.base.lag = milliseconds(250);
  ASSERT_TRUE(drive.trusts(6.0, {0.7, 0.0}));
  EXPECT_TRUE(drive.trusts(6.0, {}));
}

}  // namespace
}  // namespace topo::plausibility
