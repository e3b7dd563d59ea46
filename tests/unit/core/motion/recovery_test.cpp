// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/motion/recovery.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <vector>

namespace topo::motion {
namespace {

using std::chrono::milliseconds;

struct StuckRobot {
  types::RobotLimits limits;
  BreadcrumbPath trail;
  Recovery recovery;
  RecoveryInput in;

  StuckRobot() {
    for (double x = -1.0; x <= 0.0; x += 0.01) trail.update({x, 0.0, 0.0});
    in.now = types::stamp_from_seconds(50.0);
    in.goal_id = 1;
    in.blind_s = 2.15;
    in.trail = &trail;
    in.limits = &limits;
    (void)recovery.step(in);
  }
  /// A period in which the robot does what it is told.
  RecoveryOutput step() {
    const RecoveryOutput out = recovery.step(in);
    in.now += milliseconds(50);
    in.T_odom_base = in.T_odom_base * types::Se2{out.twist.v_mps * 0.05, 0.0, out.twist.omega_radps * 0.05};
    trail.update(in.T_odom_base);
    return out;
  }
};

TEST(Recovery, WaitsForAPersonWhoGoes) {
  StuckRobot s;
  s.in.blocked = true;
  for (int i = 0; i < 40; ++i) EXPECT_EQ(s.step().twist, types::Twist2{});
  EXPECT_EQ(s.step().phase, RecoveryPhase::kWaiting);
  s.in.blocked = false;
  EXPECT_EQ(s.step().phase, RecoveryPhase::kNone);
  EXPECT_EQ(s.recovery.begun(), 0U);
}

TEST(Recovery, BacksOffAtMostHalfAMetreAndNotFasterThanATenth) {
  StuckRobot s;
  s.in.blocked = true;
  s.in.turn_rad = 1.0;
  bool turned = false;
  for (int i = 0; i < 300 && !turned; ++i) {
    const RecoveryOutput out = s.step();
    EXPECT_GE(out.twist.v_mps, -0.1);
    EXPECT_TRUE(out.backing == Backing::kAlongTrail || out.twist.v_mps >= 0.0);
    turned = out.phase == RecoveryPhase::kTurning;
  }
  EXPECT_TRUE(turned);
  EXPECT_LT(s.in.T_odom_base.x_m, -0.4);
  EXPECT_GT(s.in.T_odom_base.x_m, -0.52);
}

/// A jamb one centimetre inside the circle that it turns in held a robot until its exploration was over: to
/// back off farther at full speed the trail was too short.
TEST(Recovery, CreepsBackNearTheEndOfItsTrail) {
  StuckRobot s;
  s.trail.clear();
  for (double x = -0.3; x <= 0.0; x += 0.01) s.trail.update({x, 0.0, 0.0});
  s.in.blocked = true;
  s.in.turn_rad = 1.0;
  for (int i = 0; i < 200 && s.recovery.begun() < 2; ++i) {
    const double behind_m = s.trail.behind_m();
    const RecoveryOutput out = s.step();
    EXPECT_LE(-out.twist.v_mps * s.in.blind_s, behind_m + 1e-9) << "if the host dies it rolls off the trail";
    if (out.phase == RecoveryPhase::kTurning) break;
  }
  EXPECT_LT(s.in.T_odom_base.x_m, -0.2) << "two thirds of the trail";
}

TEST(Recovery, BacksOffFartherAtTheNextTry) {
  StuckRobot s;
  std::vector<double> backed_m;
  while (backed_m.size() < 2 && s.in.now < types::stamp_from_seconds(120.0)) {
    const double from_m = s.in.T_odom_base.x_m;
    s.in.blocked = true;
    while (s.step().backing != Backing::kAlongTrail) ASSERT_LT(s.in.now, types::stamp_from_seconds(120.0));
    s.in.blocked = false;  // the way is free at once, and closed again when the robot is back where it was
    while (s.step().backing == Backing::kAlongTrail) {
    }
    backed_m.push_back(from_m - s.in.T_odom_base.x_m);
    for (double x = s.in.T_odom_base.x_m; x <= from_m; x += 0.01) s.trail.update({x, 0.0, 0.0});
    s.in.T_odom_base.x_m = from_m;
  }
  ASSERT_EQ(backed_m.size(), 2U);
  EXPECT_NEAR(backed_m[0], 0.2, 0.02);
  EXPECT_NEAR(backed_m[1], 0.4, 0.02);
}

/// In a dead end half a metre wide the tail of a robot that backed off 0.3 rad aside met the wall.
TEST(Recovery, BacksOffOnlyWhenTheTrailIsBehindIt) {
  for (const double turned_rad : {-0.34, -0.2, 0.15, 0.3}) {
    StuckRobot s;
    s.in.blocked = true;
    s.in.T_odom_base.theta_rad = turned_rad;
    s.trail.update(s.in.T_odom_base);
    bool backs_off = false;
    for (int i = 0; i < 200 && !backs_off; ++i) {
      const double aside_rad = s.trail.turn_to_back_rad();
      backs_off = s.step().backing == Backing::kAlongTrail;
      EXPECT_TRUE(!backs_off || std::abs(aside_rad) <= 0.1) << turned_rad;
    }
    EXPECT_TRUE(backs_off) << turned_rad;
  }
}

/// Ten degrees askew in a doorway, one corner 2 cm from the jamb: there was no room to turn, and it stayed.
TEST(Recovery, WhoHasNoRoomForASmallTurnBacksOffAsItStands) {
  StuckRobot s;
  s.in.blocked = true;
  s.in.T_odom_base.theta_rad = 0.2;
  s.trail.update(s.in.T_odom_base);
  bool backs_off = false;
  double turned_rad = 0.0;
  for (int i = 0; i < 200 && !backs_off; ++i) {
    const types::Se2 before = s.in.T_odom_base;
    const RecoveryOutput out = s.step();
    backs_off = out.backing == Backing::kAlongTrail;
    s.in.refused = !backs_off && out.twist.omega_radps != 0.0;
    if (s.in.refused) s.in.T_odom_base = before;
    s.trail.update(s.in.T_odom_base);
    turned_rad = std::max(turned_rad, std::abs(s.in.T_odom_base.theta_rad - 0.2));
    if (out.phase == RecoveryPhase::kTurning) break;
  }
  EXPECT_TRUE(backs_off);
  EXPECT_LT(turned_rad, 0.05) << "not the long way round";
}

/// Turned aside between furniture, with something in the corner that the shorter turn back would sweep.
TEST(Recovery, ATurnBackThatIsRefusedOneWayRoundIsMadeTheOther) {
  StuckRobot s;
  s.in.blocked = true;
  for (int i = 0; i < 100; ++i) {
    s.in.T_odom_base.theta_rad = 2.0 * i / 100.0;
    s.trail.update(s.in.T_odom_base);
  }
  double turned_left_rad = 0.0;
  bool backs_off = false;
  for (int i = 0; i < 400 && !backs_off; ++i) {
    const types::Se2 before = s.in.T_odom_base;
    const RecoveryOutput out = s.step();
    backs_off = out.backing == Backing::kAlongTrail;
    s.in.refused = out.twist.omega_radps < 0.0 && !backs_off;
    if (s.in.refused) s.in.T_odom_base = before;
    s.trail.update(s.in.T_odom_base);
    if (!s.in.refused && !backs_off) turned_left_rad += out.twist.omega_radps * 0.05;
  }
  EXPECT_TRUE(backs_off) << "the trail lies behind it again";
  EXPECT_GT(turned_left_rad, 3.0) << "the long way round";
}

/// May not turn: all that it may do is to go back where its scanner looked, or straight on.
struct CaughtRobot : StuckRobot {
  BreadcrumbPath no_trail;
  double seen_to_m;         ///< behind where it stood at first
  double ahead_to_m;        ///< ahead of it
  double rolls_to_m = 0.0;  ///< back, if the host dies

  CaughtRobot(double seen_behind_m, double free_ahead_m)
      : seen_to_m(seen_behind_m), ahead_to_m(free_ahead_m) {
    in.trail = &no_trail;
    in.blocked = true;
    in.turn_rad = 3.0;
    in.blind_s = 0.8;
  }
  /// Where it is after one more try, metres ahead of where it stood at first.
  double one_try() {
    const std::uint32_t begun = recovery.begun();
    for (int i = 0; i < 2000; ++i) {
      const types::Se2 before = in.T_odom_base;
      in.seen_behind_m = std::clamp(seen_to_m + before.x_m, 0.0, EasingParams{}.seen_max_m);
      in.ahead_m = std::max(0.0, ahead_to_m - before.x_m);
      const RecoveryOutput out = step();
      EXPECT_EQ(out.backing == Backing::kOverSeenGround, out.phase == RecoveryPhase::kEasing);
      EXPECT_TRUE(out.twist.v_mps >= 0.0 || out.phase == RecoveryPhase::kEasing);
      if (out.twist.v_mps < 0.0)
        rolls_to_m = std::max(rolls_to_m, -before.x_m - out.twist.v_mps * in.blind_s);
      in.refused = out.twist.omega_radps != 0.0 || in.T_odom_base.x_m > ahead_to_m;
      if (in.refused) in.T_odom_base = before;
      if (recovery.begun() == begun + 1 && out.phase == RecoveryPhase::kNone) break;
    }
    EXPECT_EQ(recovery.begun(), begun + 1);
    return in.T_odom_base.x_m;
  }
};

/// One jamb 0.28 m ahead, within the circle that it turns in, and nothing else near it: robots stood there
/// until the exploration was over.
TEST(Recovery, WithoutOtherMovesItEasesBackOverSeenGround) {
  CaughtRobot s(2.0, 0.05);
  EXPECT_NEAR(s.one_try(), -0.08, 0.005);
  EXPECT_NEAR(s.one_try(), -0.24, 0.005) << "farther at the next try";
  EXPECT_NEAR(s.one_try(), -0.48, 0.005) << "though by now there is room ahead";
}

/// Beside an open door, the scanner's room ahead: a robot that only eased back was left there.
TEST(Recovery, TriesTheSideWithRoomFirst) {
  CaughtRobot s(2.0, 0.3);
  EXPECT_NEAR(s.one_try(), 0.3, 0.01);
  EXPECT_NEAR(s.one_try(), 0.3 - 0.16, 0.01);
}

TEST(Recovery, EasesBackOverSeenGroundAndThenGoesOn) {
  CaughtRobot unseen(0.0, 0.1);
  EXPECT_NEAR(unseen.one_try(), 0.1, 0.01);
  EXPECT_EQ(unseen.rolls_to_m, 0.0);
  CaughtRobot s(0.06, 0.1);
  EXPECT_NEAR(s.one_try(), 0.1, 0.01);
  EXPECT_GT(s.rolls_to_m, 0.03);
  EXPECT_LE(s.rolls_to_m, 0.06 + 1e-9) << "if the host dies it rolls on";
}

/// In a doorway, 0.29 m from the jamb, with a mate behind: robots were left there for good.
TEST(Recovery, WhoCanNeitherBackOffNorTurnGoesALittleStraightOn) {
  StuckRobot s;
  const BreadcrumbPath none;
  s.in.trail = &none;
  s.in.blocked = true;
  s.in.turn_rad = 3.0;
  bool leaves = false;
  for (int i = 0; i < 400 && s.in.T_odom_base.x_m < 0.5; ++i) {
    const types::Se2 before = s.in.T_odom_base;
    const RecoveryOutput out = s.step();
    s.in.refused = out.twist.omega_radps != 0.0;
    if (s.in.refused) s.in.T_odom_base = before;
    if (out.phase == RecoveryPhase::kLeaving) leaves = true;
    EXPECT_LE(out.twist.v_mps, 0.1);
    if (leaves && out.phase == RecoveryPhase::kNone) break;
  }
  EXPECT_TRUE(leaves);
  EXPECT_NEAR(s.in.T_odom_base.x_m, 0.4, 0.02);
}

TEST(Recovery, WhoTouchesSomethingOrHasBackedOffDoesNotGoStraightOn) {
  for (const bool touches : {true, false}) {
    StuckRobot s;
    const BreadcrumbPath none;
    if (touches) s.in.trail = &none;
    s.in.blocked = true;
    s.in.touching = touches;
    s.in.turn_rad = 3.0;
    for (int i = 0; i < 600; ++i) {
      const types::Se2 before = s.in.T_odom_base;
      const RecoveryOutput out = s.step();
      s.in.refused = out.twist.omega_radps != 0.0;
      if (s.in.refused) s.in.T_odom_base = before;
      if (s.recovery.begun() > 1) break;  // the first try: the trail has an end
      ASSERT_NE(out.phase, RecoveryPhase::kLeaving);
    }
    EXPECT_GT(s.recovery.begun(), 1U);
  }
}

TEST(Recovery, ABlockedRobotIsStuckWithinAMinute) {
  EXPECT_TRUE(rc::check([] {
    StuckRobot s;
    s.in.blocked = true;
    double seconds = 0.0;
    while (s.step().phase != RecoveryPhase::kStuck && seconds < 100.0) {
      seconds += 0.05;
      s.in.touching = *rc::gen::inRange(0, 3) == 0;
      s.in.refused = *rc::gen::arbitrary<bool>();
      s.in.turn_rad = *rc::gen::inRange(-314, 315) * 0.01;
    }
    RC_ASSERT(seconds < 60.0);
    s.in.blocked = s.in.touching = false;
    for (int i = 0; i < 100; ++i) RC_ASSERT(s.step().phase == RecoveryPhase::kStuck);
    ++s.in.goal_id;
    RC_ASSERT(s.step().phase == RecoveryPhase::kNone);
  }));
}

TEST(Recovery, WithoutProgressItTriesThoughNothingBlocks) {
  StuckRobot s;
  for (int i = 0; i < 159; ++i) ASSERT_EQ(s.step().phase, RecoveryPhase::kNone) << i;
  for (int i = 0; i < 3; ++i) (void)s.step();
  EXPECT_EQ(s.recovery.begun(), 1U) << "after eight seconds";
  StuckRobot goes;
  for (int i = 0; i < 400; ++i) {
    goes.in.T_odom_base.x_m += 0.002;  // 0.16 m in four seconds
    EXPECT_EQ(goes.step().phase, RecoveryPhase::kNone);
  }
  EXPECT_EQ(goes.recovery.begun(), 0U);
}

TEST(Recovery, APauseIsNoLackOfProgress) {
  StuckRobot s;
  for (int i = 0; i < 600; ++i) {
    s.in.now += milliseconds(50);
    if (i % 100 == 99) {
      s.recovery.pause(s.in.now);
      continue;
    }
    EXPECT_EQ(s.recovery.step(s.in).phase, RecoveryPhase::kNone) << i;
  }
  s.in.blocked = true;
  while (s.step().phase != RecoveryPhase::kWaiting) ASSERT_EQ(s.recovery.begun(), 0U);
  s.recovery.pause(s.in.now);
  EXPECT_EQ(s.step().phase, RecoveryPhase::kNone) << "blocked anew from here on";
}

TEST(Recovery, ATouchIsNotWaitedFor) {
  for (const bool touches : {false, true}) {
    StuckRobot s;
    s.in.blocked = true;
    s.in.touching = touches;
    const types::Stamp from = s.in.now;
    while (s.recovery.begun() == 0 && s.in.now < from + std::chrono::seconds(10)) (void)s.step();
    const double waited_s = types::to_seconds(s.in.now - from);
    EXPECT_NEAR(waited_s, touches ? 0.3 : 2.5, 0.11);
  }
}

TEST(Recovery, AMetreOnTheTriesBeginAnew) {
  StuckRobot s;
  for (int tries = 0; tries < 8; ++tries) {
    s.in.blocked = true;
    while (s.step().backing != Backing::kAlongTrail)
      ASSERT_NE(s.recovery.step(s.in).phase, RecoveryPhase::kStuck) << tries;
    s.in.blocked = false;
    while (s.step().phase != RecoveryPhase::kNone) {
    }
    const double from_m = s.in.T_odom_base.x_m;
    for (double x = from_m; x <= from_m + 1.5; x += 0.05) {
      s.in.T_odom_base.x_m = x;
      s.trail.update(s.in.T_odom_base);
      (void)s.step();
    }
  }
  EXPECT_EQ(s.recovery.begun(), 8U);
}

TEST(Recovery, OfTheMirroredRobotIsTheMirroredOne) {
  EXPECT_TRUE(rc::check([] {
    StuckRobot left, right;
    left.in.blocked = right.in.blocked = true;
    for (int i = 0; i < 600; ++i) {
      if (*rc::gen::inRange(0, 20) == 0) {
        left.in.turn_rad = *rc::gen::inRange(-314, 315) * 0.01 + 0.003;
        right.in.turn_rad = -left.in.turn_rad;
        left.in.refused = right.in.refused = *rc::gen::arbitrary<bool>();
        left.in.ahead_m = right.in.ahead_m = *rc::gen::element(0.0, 0.4);
        left.in.seen_behind_m = right.in.seen_behind_m = *rc::gen::element(0.0, 0.15);
      }
      const RecoveryOutput a = left.step(), b = right.step();
      RC_ASSERT(a.phase == b.phase);
      RC_ASSERT(a.backing == b.backing);
      RC_ASSERT(std::abs(a.twist.v_mps - b.twist.v_mps) < 1e-9);
      RC_ASSERT(std::abs(a.twist.omega_radps + b.twist.omega_radps) < 1e-6);
      RC_ASSERT((a.phase != RecoveryPhase::kNone || a.twist == types::Twist2{}));
      RC_ASSERT((a.twist.v_mps >= 0.0 || a.backing != Backing::kNone));
    }
    RC_ASSERT(left.recovery.begun() == right.recovery.begun());
  }));
}

}  // namespace
}  // namespace topo::motion
