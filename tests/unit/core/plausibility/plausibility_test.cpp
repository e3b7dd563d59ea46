// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/plausibility/plausibility.hpp"

#include <gtest/gtest.h>

#include "tests/unit/core/plausibility/driven_base.hpp"

namespace topo::plausibility {
namespace {

using std::chrono::milliseconds;

struct Robot {
  testing::DrivenBase base;
  testing::Ramp ramp;
  Plausibility plausibility;
  types::Twist2 sent;
  Opinion opinion;

  /// Drives while nothing is doubted, as the gate does.
  template <class Change>
  void run(double seconds, double v_mps, Change change) {
    const types::Stamp end = base.now + types::from_seconds(seconds);
    while (base.now < end) {
      if (opinion.doubts.any()) ramp.stop();
      sent = opinion.doubts.any() ? types::Twist2{} : ramp.towards({v_mps, 0.0});
      base.step(sent);
      Evidence evidence;
      evidence.now = base.now;
      evidence.commanded = sent;
      evidence.base = &base.state;
      change(evidence);
      opinion = plausibility.judge(evidence);
    }
  }
  void run(double seconds, double v_mps) {
    run(seconds, v_mps, [](Evidence&) {});
  }
  [[nodiscard]] bool doubts(Doubt doubt) const { return has(opinion.doubts, doubt); }
};

TEST(Plausibility, believesAGoodRobot) {
  Robot robot;
  for (int leg = 0; leg < 20; ++leg) {
    robot.run(3.0, leg % 2 == 0 ? 0.7 : 0.0);
    ASSERT_TRUE(robot.opinion.doubts.none()) << leg << found_text(robot.opinion.doubts);
  }
  EXPECT_LE(robot.opinion.lag, milliseconds(200));
}

TEST(Plausibility, lateDataStopTheRobotUntilTheyAreFresh) {
  Robot robot;
  robot.run(3.0, 0.5);
  robot.run(1.0, 0.5, [&](Evidence&) { robot.base.state.late = milliseconds(350); });
  EXPECT_TRUE(robot.doubts(Doubt::kLateStatuses));
  robot.base.state.late = {};
  robot.run(3.0, 0.5);
  EXPECT_TRUE(robot.opinion.doubts.none());
}

TEST(Plausibility, disobedienceLastsUntilTheMotorsAreOff) {
  Robot robot;
  robot.run(4.0, 0.5);
  robot.base.obeys = false;
  robot.run(4.0, 0.0);
  ASSERT_TRUE(robot.doubts(Doubt::kDisobeys));
  robot.base.push(0.0);
  robot.run(60.0, 0.0, [&](Evidence&) { robot.base.push(0.0); });
  ASSERT_TRUE(robot.doubts(Doubt::kDisobeys)) << "standing alone is no reason to trust it again";
  robot.base.state.motors_enabled = false;
  robot.run(2.0, 0.0, [&](Evidence&) { robot.base.push(0.0); });
  EXPECT_FALSE(robot.doubts(Doubt::kDisobeys));
}

TEST(Plausibility, theOperatorClearsAtAStandingRobotOnly) {
  Robot robot;
  robot.run(4.0, 0.5);
  robot.base.obeys = false;
  robot.run(4.0, 0.0);
  const auto clear = [](Evidence& evidence) { evidence.cleared = true; };
  robot.run(0.1, 0.0, clear);
  ASSERT_TRUE(robot.doubts(Doubt::kDisobeys)) << "it still drives";
  robot.base.push(0.0);
  robot.run(2.0, 0.0, [&](Evidence&) { robot.base.push(0.0); });
  robot.run(0.1, 0.0, [&](Evidence& evidence) {
    robot.base.push(0.0);
    evidence.cleared = true;
  });
  robot.run(2.0, 0.0, [&](Evidence&) { robot.base.push(0.0); });
  EXPECT_FALSE(robot.doubts(Doubt::kDisobeys));
}

TEST(Plausibility, aSlowBaseThatDoesNotStopDisobeys) {
  Robot robot;
  robot.run(3.0, 0.07);
  robot.base.obeys = false;
  robot.run(1.5, 0.0);
  EXPECT_TRUE(robot.opinion.doubts.none()) << "it may roll";
  robot.run(2.0, 0.0);
  EXPECT_TRUE(robot.doubts(Doubt::kDisobeys));
}

TEST(Plausibility, aPushOfAStandingRobotIsNoDisobedience) {
  Robot robot;
  for (int push = 0; push < 10; ++push) {
    robot.run(1.5, 0.0, [&](Evidence&) { robot.base.push(0.08); });
    robot.run(0.5, 0.0, [&](Evidence&) { robot.base.push(0.0); });
    ASSERT_TRUE(robot.opinion.doubts.none()) << push;
  }
}

/// A base that disobeyed and stands, without a connection.
Robot lost_after_disobedience() {
  Robot robot;
  robot.run(4.0, 0.5);
  robot.base.obeys = false;
  robot.run(4.0, 0.0);
  EXPECT_TRUE(robot.doubts(Doubt::kDisobeys));
  robot.run(1.0, 0.0, [&](Evidence& evidence) {
    robot.base.push(0.0);
    evidence.base = nullptr;
  });
  return robot;
}

TEST(Plausibility, aNewConnectionIsNoReasonToTrustTheBase) {
  Robot robot = lost_after_disobedience();
  ASSERT_TRUE(robot.doubts(Doubt::kDisobeys));
  robot.run(60.0, 0.0, [&](Evidence&) { robot.base.push(0.0); });
  EXPECT_TRUE(robot.doubts(Doubt::kDisobeys));
}

TEST(Plausibility, aReleasedBaseIsTrustedAtOnce) {
  Robot robot = lost_after_disobedience();
  robot.run(0.05, 0.0, [](Evidence& evidence) {
    evidence.base = nullptr;
    evidence.base_released = true;
  });
  EXPECT_FALSE(robot.doubts(Doubt::kDisobeys));
  robot.run(2.0, 0.0, [&](Evidence&) { robot.base.push(0.0); });
  EXPECT_TRUE(robot.opinion.doubts.none());
}

TEST(Plausibility, anUnheardBaseIsClearedWhenItMustStand) {
  Robot robot = lost_after_disobedience();
  const auto clear = [](Evidence& evidence) {
    evidence.base = nullptr;
    evidence.cleared = true;
  };
  robot.run(0.05, 0.0, clear);
  ASSERT_TRUE(robot.doubts(Doubt::kDisobeys)) << "a second after its last status it may drive";
  robot.run(5.0, 0.0, [](Evidence& evidence) { evidence.base = nullptr; });
  ASSERT_TRUE(robot.doubts(Doubt::kDisobeys)) << "time alone ends nothing";
  robot.run(0.05, 0.0, clear);
  EXPECT_FALSE(robot.doubts(Doubt::kDisobeys));
}

TEST(Plausibility, disobedienceOutlivesARestart) {
  Robot robot;
  robot.plausibility = Plausibility({}, true);
  robot.run(10.0, 0.5);
  EXPECT_TRUE(robot.doubts(Doubt::kDisobeys));
  EXPECT_EQ(robot.base.v_mps(), 0.0);
  robot.run(0.05, 0.0, [](Evidence& evidence) { evidence.cleared = true; });
  EXPECT_FALSE(robot.doubts(Doubt::kDisobeys));
}

TEST(Plausibility, anUnheardBaseIsNotClearedAtTheStart) {
  Robot robot;
  robot.plausibility = Plausibility({}, true);
  robot.run(1.0, 0.0, [](Evidence& evidence) {
    evidence.base = nullptr;
    evidence.cleared = true;
  });
  EXPECT_TRUE(robot.doubts(Doubt::kDisobeys));
}

TEST(Plausibility, theThirdStrikeInAMinuteStays) {
  Robot robot;
  for (int strike = 1; strike <= 3; ++strike) {
    robot.run(0.5, 0.0, [&](Evidence&) { robot.base.state.late = milliseconds(500); });
    robot.base.state.late = {};
    ASSERT_TRUE(robot.doubts(Doubt::kLateStatuses));
    robot.run(5.0, 0.0);
    ASSERT_EQ(robot.doubts(Doubt::kLateStatuses), strike == 3);
  }
  robot.run(120.0, 0.0);
  EXPECT_TRUE(robot.doubts(Doubt::kLateStatuses));
  robot.run(0.1, 0.0, [](Evidence& evidence) { evidence.cleared = true; });
  robot.run(2.0, 0.0);
  EXPECT_FALSE(robot.doubts(Doubt::kLateStatuses));
}

TEST(Plausibility, lateCommandsAreKnownAndLatchAtLast) {
  Robot robot;
  robot.base.lag = milliseconds(1200);
  robot.run(60.0, 0.7);
  EXPECT_TRUE(robot.doubts(Doubt::kAnswersLate));
  EXPECT_GT(robot.opinion.lag, milliseconds(700));
  robot.run(60.0, 0.7);
  EXPECT_TRUE(robot.doubts(Doubt::kAnswersLate)) << "latched";
  EXPECT_NEAR(robot.base.v_mps(), 0.0, 1e-9);
}

// It decides every 250 ms and reads statuses that wait for 150 ms by then, as under a thread of a higher
// priority: commands and statuses are late by the same.
TEST(Plausibility, aHostThatIsLateItselfIsNotTheBasesFault) {
  testing::DrivenBase base;
  testing::Ramp ramp;
  Plausibility plausibility;
  for (int period = 0; period < 240; ++period) {
    const types::Twist2 sent = ramp.towards({period / 12 % 2 == 0 ? 0.7 : 0.0, 0.0});
    types::BaseState waiting;
    for (int i = 0; i < 5; ++i) {
      if (base.step(sent) && i < 2) waiting = base.state;
    }
    waiting.arrival = waiting.odometry.stamp = base.now;
    Evidence evidence;
    evidence.now = base.now;
    evidence.commanded = sent;
    evidence.base = waiting.sequence > 0 ? &waiting : nullptr;
    ASSERT_TRUE(plausibility.judge(evidence).doubts.none()) << period;
  }
}

TEST(Plausibility, aNewConnectionMeasuresTheLagAnew) {
  Robot robot;
  robot.base.lag = milliseconds(600);
  for (int i = 0; i < 100 && !robot.doubts(Doubt::kAnswersLate); ++i) robot.run(0.1, 0.7);
  ASSERT_TRUE(robot.doubts(Doubt::kAnswersLate));
  robot.base.lag = milliseconds(100);
  robot.run(3.0, 0.0, [&](Evidence& evidence) {
    robot.base.push(0.0);
    evidence.base = nullptr;
  });
  robot.run(0.2, 0.0);
  EXPECT_LE(robot.opinion.lag, milliseconds(300)) << "of the old connection";
  for (int leg = 0; leg < 6; ++leg) robot.run(3.0, leg % 2 == 0 ? 0.7 : 0.0);
  EXPECT_LE(robot.opinion.lag, milliseconds(300));
  EXPECT_TRUE(robot.opinion.doubts.none()) << found_text(robot.opinion.doubts);
}

TEST(Plausibility, motorsThatWereSwitchedOffStayOff) {
  Robot robot;
  robot.run(4.0, 0.5, [](Evidence& evidence) { evidence.motors_wanted = true; });
  robot.base.state.motors_enabled = false;
  const auto still = [&](Evidence& evidence) {
    robot.base.push(0.0);
    evidence.motors_wanted = true;
  };
  robot.run(0.2, 0.5, still);
  ASSERT_TRUE(robot.doubts(Doubt::kMotorsOff));
  robot.run(60.0, 0.5, still);
  EXPECT_TRUE(robot.doubts(Doubt::kMotorsOff));
  robot.base.state.motors_enabled = true;
  robot.run(5.0, 0.5, still);
  EXPECT_TRUE(robot.doubts(Doubt::kMotorsOff)) << "also when the button is pressed again";
  robot.run(0.1, 0.5, [&](Evidence& evidence) {
    still(evidence);
    evidence.cleared = true;
  });
  robot.run(2.0, 0.5, still);
  EXPECT_FALSE(robot.doubts(Doubt::kMotorsOff));
}

TEST(Plausibility, everyDoubtHasWordsAndACure) {
  for (const DoubtText& text : doubt_texts()) {
    EXPECT_FALSE(text.name.empty());
    EXPECT_FALSE(text.found.empty());
    EXPECT_NE(text.cure.find("ends"), std::string_view::npos) << text.name << ": how the doubt ends";
  }
  DoubtSet set;
  EXPECT_EQ(found_text(set), "");
  set.set(static_cast<std::size_t>(Doubt::kCovered));
  set.set(static_cast<std::size_t>(Doubt::kAnswersLate));
  EXPECT_EQ(found_text(set), text_of(Doubt::kAnswersLate).found) << "the gravest";
}

}  // namespace
}  // namespace topo::plausibility
