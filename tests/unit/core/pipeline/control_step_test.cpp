// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/control_step.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>
#include <memory>

#include "core/pipeline/control_evidence.hpp"
#include "tests/unit/support/allocation_counter.hpp"

namespace topo::pipeline {
namespace {

using motion::GateReason;
using std::chrono::milliseconds;

/// The same scan again and again, in an empty place, and poses put where a test wants them: what
/// core/plausibility is for is tested there.
ControlParams trusting() {
  ControlParams params;
  plausibility::PlausibilityParams& p = params.plausibility;
  p.picture.noiseless = p.picture.open_space = true;
  p.motion.step_m = p.motion.step_rad = 1e6;
  return params;
}

class ControlStepTest : public ::testing::Test {
 protected:
  ControlStepTest() {
    scan->geometry = {-2.356F, 0.004363F, 0.000017F, 0.025F, 0.1F, 30.0F};
    scan->beams = 1081;
    scan->range_m.fill(10.0F);
    scan->first_beam = scan->arrival = now;
    state.arrival = now;
    drive = {now, {0.3, 0.0}};
    input.now = now;
    input.teleop = &drive;
    input.state = &state;
    input.front = scan.get();
    input.firmware_watchdog = milliseconds(500);
  }
  /// Some periods of the same input, with everything in it kept fresh.
  ControlOutput run(int periods) {
    ControlOutput decision;
    for (int i = 0; i < periods; ++i) {
      now += milliseconds(50);
      input.now = state.arrival = scan->arrival = scan->first_beam = now;
      if (keep_asking) drive.stamp = now;
      decision = control_step(memory, setup, input);
      input.estop_cleared = false;
    }
    return decision;
  }

  types::Stamp now = types::stamp_from_seconds(100.0);
  std::unique_ptr<types::Scan> scan = std::make_unique<types::Scan>();
  types::BaseState state;
  Teleop drive;
  ControlSetup setup;
  ControlInput input;
  ControlState memory{trusting()};
  bool keep_asking = true;
};

TEST_F(ControlStepTest, DrivesAsTheOperatorWants) {
  const auto decision = run(40);
  EXPECT_EQ(decision.report.reason, GateReason::kFree);
  EXPECT_EQ(decision.report.mode, ControlMode::kTeleop);
  EXPECT_TRUE(decision.command.enable_motors);
  EXPECT_NEAR(decision.command.twist.v_mps, 0.3, 1e-9);
}

TEST_F(ControlStepTest, AWatchdogOnTrialPermitsASlowTurnByHandAlone) {
  input.watchdog_on_trial = true;
  EXPECT_EQ(run(40).command.twist, types::Twist2{});
  drive.twist = {0.3, 1.0};
  const auto turn = run(40).command.twist;
  EXPECT_EQ(turn.v_mps, 0.0);
  EXPECT_NEAR(turn.omega_radps, setup.limits.omega_beside_radps, 1e-9);
  input.teleop = nullptr;
  Plan plan;
  plan.stamp = now;
  plan.moving = true;
  plan.points = 1;
  input.plan = &plan;
  EXPECT_EQ(run(1).report.mode, ControlMode::kStanding);
}

TEST_F(ControlStepTest, StandsWithMotorsOffBeforeAnybodyAsks) {
  input.teleop = nullptr;
  const auto decision = run(5);
  EXPECT_EQ(decision.command.twist, types::Twist2{});
  EXPECT_FALSE(decision.command.enable_motors);
  EXPECT_EQ(decision.report.mode, ControlMode::kStanding);
}

TEST_F(ControlStepTest, DeadManStops) {
  run(40);
  keep_asking = false;
  const auto soon = run(6);  // 300 ms
  EXPECT_EQ(soon.report.mode, ControlMode::kTeleop);
  const auto later = run(20);
  EXPECT_EQ(later.report.mode, ControlMode::kStanding);
  EXPECT_EQ(later.command.twist, types::Twist2{});
  EXPECT_TRUE(later.command.enable_motors);
}

TEST_F(ControlStepTest, MotorsSwitchedOffByHandStayOff) {
  state.motors_enabled = true;
  run(40);
  state.motors_enabled = false;
  auto decision = run(2);
  EXPECT_TRUE(has(decision.report.plausibility.doubts, plausibility::Doubt::kMotorsOff));
  EXPECT_EQ(decision.report.reason, GateReason::kImplausible);
  EXPECT_EQ(decision.command.twist, types::Twist2{});
  EXPECT_FALSE(decision.command.enable_motors);
  decision = run(400);
  EXPECT_FALSE(decision.command.enable_motors) << "the operator still asks for motion";
  input.estop_cleared = true;
  run(1);
  input.estop_cleared = false;
  decision = run(60);
  EXPECT_TRUE(decision.command.enable_motors);
}

TEST_F(ControlStepTest, EstopLatchesUntilClearedAndThenWantsANewCommand) {
  run(40);
  input.estop = true;
  auto decision = run(1);
  EXPECT_TRUE(decision.command.estop);
  EXPECT_EQ(decision.command.twist, types::Twist2{});
  input.estop = false;
  decision = run(3);
  EXPECT_EQ(decision.report.reason, GateReason::kEmergencyStop);
  keep_asking = false;
  drive.stamp = {};  // as App::clear_estop does
  input.estop_cleared = true;
  decision = run(2);
  EXPECT_FALSE(decision.command.estop);
  EXPECT_FALSE(decision.command.enable_motors);
  EXPECT_EQ(decision.command.twist, types::Twist2{});
  keep_asking = true;
  EXPECT_GT(run(10).command.twist.v_mps, 0.0);
}

TEST_F(ControlStepTest, ItsParametersReachTheGate) {
  const auto reason_with = [this](auto&& change) {
    ControlParams params = trusting();
    change(params);
    ControlState fresh(params);
    drive.stamp = input.now;
    return control_step(fresh, setup, input).report.reason;
  };
  run(1);
  EXPECT_NE(reason_with([](ControlParams&) {}), GateReason::kBlindScan);
  EXPECT_EQ(reason_with([](ControlParams& p) { p.motion.gate.valid_share_min = 1.1; }),
            GateReason::kBlindScan);
  // Beams of 2.5 degrees to either side alone are valid: enough for a sector of two.
  scan->range_m.fill(std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < 20; ++i) scan->range_m[530 + i] = 10.0F;
  EXPECT_EQ(reason_with([](ControlParams&) {}), GateReason::kBlindScan);
  EXPECT_NE(reason_with([](ControlParams& p) {
              p.perception.stop_zone.forward_sector_rad = 2.0 * types::kDegree_rad;
            }),
            GateReason::kBlindScan);
}

TEST_F(ControlStepTest, MotorsStayOnAsLongAsTheParameterSays) {
  const auto enabled_after = [this](types::Duration linger, int periods) {
    ControlParams params = trusting();
    params.motors_linger = linger;
    ControlState fresh(params);
    drive.stamp = input.now;
    (void)control_step(fresh, setup, input);
    drive.stamp = {};
    ControlOutput out;
    for (int i = 0; i < periods; ++i) {
      now += milliseconds(50);
      input.now = state.arrival = scan->arrival = scan->first_beam = now;
      out = control_step(fresh, setup, input);
    }
    return out.command.enable_motors;
  };
  run(1);
  EXPECT_TRUE(enabled_after(milliseconds(200), 4));
  EXPECT_FALSE(enabled_after(milliseconds(200), 5));
}

TEST_F(ControlStepTest, WhateverIsStaleOrMissingStops) {
  const auto stops = [this](auto&& spoil) {
    ControlState fresh(trusting());
    ControlInput spoiled = input;
    drive.stamp = spoiled.now;
    spoil(spoiled);
    EXPECT_EQ(control_step(fresh, setup, spoiled).command.twist, types::Twist2{});
  };
  run(1);
  stops([](ControlInput& i) { i.state = nullptr; });
  stops([](ControlInput& i) { i.front = nullptr; });
  stops([](ControlInput& i) { i.firmware_watchdog = {}; });
  stops([](ControlInput& i) { i.now += milliseconds(151); });
  stops([](ControlInput& i) { i.estop = true; });
}

Plan plan_ahead(types::Stamp stamp) {
  Plan plan;
  plan.stamp = stamp;
  plan.sequence = plan.goal_id = 1;
  plan.moving = plan.path_ends_at_goal = plan.located = true;
  plan.points = 50;
  for (std::size_t i = 0; i < plan.points; ++i) plan.path_odom[i] = {0.1 * static_cast<double>(i), 0.0};
  return plan;
}

TEST_F(ControlStepTest, FollowsAFreshPlanAndStandsWhenItGetsOld) {
  input.teleop = nullptr;
  Plan plan = plan_ahead(now);
  input.plan = &plan;
  for (int i = 0; i < 20; ++i) plan.stamp = now, run(1);
  EXPECT_GT(run(1).command.twist.v_mps, 0.1);
  EXPECT_EQ(run(1).report.mode, ControlMode::kFollowing);
  EXPECT_EQ(run(60).command.twist, types::Twist2{}) << "a second and the ramp later";
  EXPECT_EQ(run(1).report.mode, ControlMode::kStanding);
}

TEST_F(ControlStepTest, ARestartNeverMovesByItself) {
  EXPECT_TRUE(rc::check("any old plan and any old wish", [this] {
    ControlState fresh(trusting());
    ControlInput after = input;
    Plan plan = plan_ahead(after.now - milliseconds(*rc::gen::inRange(1001, 100000)));
    Teleop old{after.now - milliseconds(*rc::gen::inRange(301, 100000)), {0.5, 0.3}};
    after.plan = *rc::gen::arbitrary<bool>() ? &plan : nullptr;
    after.teleop = *rc::gen::arbitrary<bool>() ? &old : nullptr;
    for (int i = 0; i < 20; ++i) {
      after.now += milliseconds(50);
      state.arrival = scan->arrival = scan->first_beam = after.now;
      const auto out = control_step(fresh, setup, after);
      RC_ASSERT(out.command.twist == types::Twist2{});
      RC_ASSERT(!out.command.enable_motors);
    }
  }));
}

TEST_F(ControlStepTest, AfterAnEstopThePlanHasToBeginAnew) {
  input.teleop = nullptr;
  Plan plan = plan_ahead(now);
  input.plan = &plan;
  const auto fresh = [&] { return plan.stamp = now, run(1); };
  for (int i = 0; i < 10; ++i) fresh();
  input.estop = true;
  fresh();
  input.estop = false;
  input.estop_cleared = true;
  for (int i = 0; i < 20; ++i) EXPECT_EQ(fresh().command.twist, types::Twist2{});
  plan.moving = false;
  fresh();
  plan.moving = true;
  for (int i = 0; i < 5; ++i) fresh();
  EXPECT_GT(fresh().command.twist.v_mps, 0.0);
}

TEST_F(ControlStepTest, AreaLimitsWithoutAPlaceRefuseTheHand) {
  setup.area.keep_in = types::Polygon{{-5.0, -5.0}, {5.0, -5.0}, {5.0, 5.0}, {-5.0, 5.0}};
  const auto decision = run(5);
  EXPECT_EQ(decision.report.reason, GateReason::kNoPlace);
  EXPECT_EQ(decision.command.twist, types::Twist2{});
}

TEST_F(ControlStepTest, AMapThatIsNotTheRightOneHasNoAreaLimits) {
  Plan plan = plan_ahead(now);
  input.plan = &plan;
  const auto fresh = [&] { return plan.stamp = now, run(1); };
  input.place = types::PlaceStanding::kUnknown;
  for (int i = 0; i < 5; ++i) fresh();
  EXPECT_GT(fresh().command.twist.v_mps, 0.0) << "without limits the hand may drive to where more is seen";
  setup.area.keep_in = types::Polygon{{-5.0, -5.0}, {50.0, -5.0}, {50.0, 5.0}, {-5.0, 5.0}};
  EXPECT_EQ(fresh().report.reason, GateReason::kNoPlace);
  EXPECT_EQ(fresh().command.twist, types::Twist2{});
  input.place = types::PlaceStanding::kKnown;
  for (int i = 0; i < 5; ++i) fresh();
  EXPECT_GT(fresh().command.twist.v_mps, 0.0);
  input.place = types::PlaceStanding::kDropped;
  EXPECT_EQ(fresh().report.reason, GateReason::kPlaceDropped);
  EXPECT_EQ(fresh().command.twist, types::Twist2{});
}

TEST_F(ControlStepTest, AFreshPlanWithoutAPlaceIsNoPlace) {
  setup.area.keep_in = types::Polygon{{-5.0, -5.0}, {50.0, -5.0}, {50.0, 5.0}, {-5.0, 5.0}};
  Plan plan = plan_ahead(now);
  input.plan = &plan;
  const auto fresh = [&] { return plan.stamp = now, run(1); };
  for (int i = 0; i < 5; ++i) fresh();
  EXPECT_GT(fresh().command.twist.v_mps, 0.0) << "by hand, located";
  plan.located = false;
  EXPECT_EQ(fresh().report.reason, GateReason::kNoPlace);
  EXPECT_EQ(fresh().command.twist, types::Twist2{});
  input.teleop = nullptr;
  plan.moving = true;  // which such a planner never says
  EXPECT_EQ(fresh().report.reason, GateReason::kNoPlace);
  EXPECT_EQ(fresh().command.twist, types::Twist2{});
  plan.located = true;
  for (int i = 0; i < 5; ++i) fresh();
  EXPECT_GT(fresh().command.twist.v_mps, 0.0) << "by the plan, located";
}

TEST_F(ControlStepTest, BacksOffFromWhatBlocksItButNotIntoAMate) {
  input.teleop = nullptr;
  Plan plan = plan_ahead(now);
  input.plan = &plan;
  // Four seconds on its way from the start, then six in front of something.
  const auto fastest_back_mps = [&](bool mate_behind) {
    plan.mate_behind = mate_behind;
    ++plan.goal_id;
    ++plan.sequence;
    state.odometry.T_odom_base = {0.0, 0.0, 0.0};
    scan->range_m.fill(10.0F);
    double slowest_mps = 0.0;
    for (int i = 0; i < 200; ++i) {
      if (i == 80) scan->range_m.fill(0.35F);
      plan.stamp = now;
      const double v_mps = run(1).command.twist.v_mps;
      slowest_mps = std::min(slowest_mps, v_mps);
      state.odometry.stamp = now;
      state.odometry.T_odom_base = {state.odometry.T_odom_base.se2().x_m + 0.05 * v_mps, 0.0, 0.0};
    }
    return slowest_mps;
  };
  EXPECT_EQ(fastest_back_mps(true), 0.0);
  EXPECT_LT(fastest_back_mps(false), -0.05);
}

/// A robot that stands where it came to, while its odometry turns it by 0.2 rad and the map knows better.
TEST_F(ControlStepTest, BacksOffAlongItsTrailThoughTheOdometryHasDrifted) {
  Plan plan;
  plan.located = true;
  input.plan = &plan;
  drive.twist = {};
  const auto period = [&](const types::Se2& T_map_base, const types::Se2& T_odom_base) {
    state.odometry.stamp = plan.stamp = now + milliseconds(50);
    state.odometry.T_odom_base = types::Transform2<types::Odom, types::Base>(T_odom_base);
    plan.T_map_odom = types::Transform2<types::Map, types::Odom>(T_map_base * T_odom_base.inverse());
    ++plan.sequence;
    return run(1);
  };
  for (int i = 0; i <= 50; ++i) period({0.02 * i, 0.0, 0.0}, {0.02 * i, 0.0, 0.0});
  for (int i = 0; i <= 10; ++i) period({1.0, 0.0, 0.0}, {1.0, 0.0, 0.02 * i});
  drive.twist = {-0.1, 0.0};
  types::Twist2 back;
  for (int i = 0; i < 10; ++i) back = period({1.0, 0.0, 0.0}, {1.0, 0.0, 0.2}).command.twist;
  EXPECT_LT(back.v_mps, -0.05);
  EXPECT_NEAR(back.omega_radps, 0.0, 0.02) << "the trail is straight behind";
}

TEST_F(ControlStepTest, EveryTouchIsCountedOnceWithItsPlace) {
  state.odometry.T_odom_base = {1.0, 2.0, 0.0};
  EXPECT_EQ(run(3).report.touches, 0U);
  state.bumpers_front = 4;
  EXPECT_EQ(run(1).report.touches, 1U);
  EXPECT_EQ(run(5).report.touches, 1U) << "one press, however long";
  state.bumpers_front = 0;
  const ControlReport later = run(20).report;
  EXPECT_EQ(later.touches, 1U) << "and not forgotten when it is over";
  EXPECT_NEAR(later.touched_odom.x(), 1.0 + setup.limits.footprint.front_m, 1e-9);
  state.bumpers_rear = 1;
  const ControlReport behind = run(1).report;
  EXPECT_EQ(behind.touches, 2U);
  EXPECT_NEAR(behind.touched_odom.x(), 1.0 - setup.limits.footprint.rear_m, 1e-9);
  state.bumpers_rear = 0;
  run(1);
  state.stall_left = true;
  EXPECT_EQ(run(1).report.touches, 3U);
}

TEST_F(ControlStepTest, OnlyManualControlCreepsOffAPressedRearBumper) {
  run(40);  // at 0.3 m/s
  state.bumpers_rear = 2;
  drive.twist = {0.3, 0.5};
  for (int i = 0; i < 20; ++i) {
    const types::Twist2 twist = run(1).command.twist;
    EXPECT_LE(twist.v_mps, setup.limits.v_reverse_max_mps);
    EXPECT_EQ(twist.omega_radps, 0.0) << "a turn would swing the rear into it";
    EXPECT_GT(twist.v_mps, 0.05) << i;
  }
  for (const types::Twist2 twist : {types::Twist2{-0.1, 0.0}, {0.0, 0.5}, {0.0, 0.0}}) {
    drive.twist = twist;
    EXPECT_EQ(run(1).report.reason, GateReason::kBumper);
    EXPECT_EQ(run(1).command.twist, types::Twist2{});
  }
  drive.twist = {0.3, 0.0};
  state.bumpers_front = 1;
  EXPECT_EQ(run(2).command.twist, types::Twist2{}) << "held at both ends";
  state.bumpers_front = 0;
  state.stall_left = true;
  EXPECT_EQ(run(2).command.twist, types::Twist2{});
  state.stall_left = false;
  scan->range_m.fill(0.25F);
  EXPECT_EQ(run(2).command.twist, types::Twist2{}) << "the stop zone holds as ever";
  scan->range_m.fill(10.0F);
  input.teleop = nullptr;
  Plan plan = plan_ahead(now);
  input.plan = &plan;
  for (int i = 0; i < 40; ++i) {
    plan.stamp = now;
    EXPECT_EQ(run(1).command.twist, types::Twist2{}) << "not by itself";
  }
  input.teleop = &drive;
  state.bumpers_rear = 0;
  EXPECT_GT(run(40).command.twist.v_mps, 0.25) << "and off it all is as before";
}

TEST_F(ControlStepTest, DoesNotSwingItsTailAgainstWhatItHasDrivenPast) {
  const auto post_at = [&](double bearing_rad, float range_m) {
    scan->range_m.fill(10.0F);
    for (std::size_t i = 0; i < scan->beams; ++i)
      if (std::abs(static_cast<double>(scan->angle_rad(i)) - bearing_rad) < 0.06) scan->range_m[i] = range_m;
  };
  drive.twist = {0.0, 1.0};
  EXPECT_GT(run(20).command.twist.omega_radps, 0.9) << "with nothing beside it";
  drive.twist = {};
  run(20);
  post_at(-2.2, 0.30F);  // right behind the shoulder, still in view
  run(3);
  scan->range_m.fill(10.0F);
  state.odometry.T_odom_base = types::Transform2<types::Odom, types::Base>(types::Se2{0.1, 0.0, 0.0});
  drive.twist = {0.0, 1.0};
  state.odometry.stamp = now;
  const ControlOutput beside = run(20);
  EXPECT_EQ(beside.command.twist, types::Twist2{});
  EXPECT_EQ(beside.report.reason, GateReason::kBlocked);
}

/// A round post, in the laser's frame.
void put_post(types::Scan& scan, const types::Vector2& at, double radius_m) {
  for (std::size_t i = 0; i < scan.beams; ++i) {
    const double angle = static_cast<double>(scan.angle_rad(i));
    const double along = at.dot(types::Vector2(std::cos(angle), std::sin(angle)));
    const double through = radius_m * radius_m - at.squaredNorm() + along * along;
    if (along > 0.0 && through > 0.0) scan.range_m[i] = static_cast<float>(along - std::sqrt(through));
  }
}

/// As robots stood until the exploration was over: it came along x and turned by 1.2 rad, and now there is a
/// jamb 0.27 m ahead, within the circle that it turns in; the path leads away from it, the trail lies aside.
TEST_F(ControlStepTest, AStuckRobotEasesBackOverSeenGroundNotIntoAMate) {
  struct End {
    double fastest_back_mps = 0.0;
    double way_m = 0.0;
    int periods_to_ease = 0;
  };
  const double heading_rad = 1.2;
  const types::Vector2 away(-std::cos(heading_rad), -std::sin(heading_rad));
  const auto after_a_minute = [&](bool has_looked, bool mate_behind) {
    ControlState fresh(trusting());
    types::Se2 pose;
    const auto period = [&](const Plan* plan, bool jamb) {
      now += milliseconds(50);
      input.plan = plan;
      input.now = state.arrival = scan->arrival = scan->first_beam = state.odometry.stamp = now;
      state.odometry.T_odom_base = types::Transform2<types::Odom, types::Base>(pose);
      scan->range_m.fill(10.0F);
      const types::Vector2 at = pose.inverse() * types::Vector2(-0.27 * away);
      if (jamb) put_post(*scan, at + 0.02 * at.normalized(), 0.02);
      return control_step(fresh, setup, input);
    };
    if (has_looked)
      for (int i = -50; i <= 0; ++i) pose = {0.02 * i, 0.0, 0.0}, period(nullptr, false);
    const int turns = has_looked ? 24 : 0;
    for (int i = 0; i <= turns; ++i)
      pose = {0.0, 0.0, heading_rad + 0.05 * (i - turns)}, period(nullptr, false);
    Plan plan = plan_ahead(now);
    for (std::size_t i = 0; i < plan.points; ++i) plan.path_odom[i] = 0.1 * static_cast<double>(i) * away;
    plan.mate_behind = mate_behind;
    End end;
    for (int i = 0; i < 1200 && end.way_m < 1.0; ++i) {
      plan.stamp = now;
      const types::Twist2 twist = period(&plan, true).command.twist;
      if (twist.v_mps < 0.0 && end.fastest_back_mps == 0.0) end.periods_to_ease = i;
      end.fastest_back_mps = std::min(end.fastest_back_mps, twist.v_mps);
      pose = pose * types::Se2{0.05 * twist.v_mps, 0.0, 0.05 * twist.omega_radps};
      end.way_m = pose.translation().dot(away);
    }
    return end;
  };
  input.teleop = nullptr;
  setup.limits.footprint = {0.210, 0.301, 0.2125, 0.267};
  const End free = after_a_minute(true, false);
  EXPECT_LT(free.fastest_back_mps, 0.0);
  EXPECT_GE(free.fastest_back_mps, -0.051) << "straight back, not along the trail";
  EXPECT_GT(free.way_m, 0.9);
  EXPECT_LT(free.periods_to_ease, 260) << "turns that creep towards a corner are as good as refused";
  EXPECT_EQ(after_a_minute(true, true).fastest_back_mps, 0.0) << "a mate is behind";
  EXPECT_EQ(after_a_minute(false, false).fastest_back_mps, 0.0) << "just begun: behind it nobody has looked";
}

/// Somebody walks to and fro across the way, 0.6 m ahead, two metres to either side.
void put_walker(types::Scan& scan, double t_s) {
  constexpr double kAhead_m = 0.6, kAside_m = 2.0, kSpeed_mps = 1.0;
  const double way_m = std::fmod(kSpeed_mps * t_s, 4.0 * kAside_m);
  const types::Vector2 at(kAhead_m, way_m < 2.0 * kAside_m ? way_m - kAside_m : 3.0 * kAside_m - way_m);
  scan.range_m.fill(10.0F);
  put_post(scan, at, 0.2);
}

TEST_F(ControlStepTest, WaitsForAWalkerUntilPatienceEnds) {
  input.teleop = nullptr;
  Plan plan = plan_ahead(now);
  input.plan = &plan;
  const types::Stamp from = now;
  bool waited = false, moved_before_it = false;
  std::uint32_t recoveries_soon = 0, recoveries = 0;
  for (int i = 0; i < 600; ++i) {
    plan.stamp = now;
    put_walker(*scan, types::to_seconds(now - from));
    const ControlOutput out = run(1);
    waited = waited || out.report.mode == ControlMode::kWaiting;
    moved_before_it = moved_before_it ||
                      (out.report.reason == GateReason::kGivesWay && out.command.twist != types::Twist2{});
    recoveries = out.report.recoveries;
    if (i < 190) recoveries_soon = recoveries;
  }
  EXPECT_TRUE(waited);
  EXPECT_FALSE(moved_before_it);
  EXPECT_EQ(recoveries_soon, 0U) << "in nine seconds, in which it does not get on";
  EXPECT_GE(recoveries, 1U) << "but not for ever";
}

TEST_F(ControlStepTest, AllocatesNothing) {
  Plan plan = plan_ahead(now);
  input.plan = &plan;
  setup.area.keep_in = types::Polygon{{-5.0, -5.0}, {50.0, -5.0}, {50.0, 5.0}, {-5.0, 5.0}};
  run(2);
  const std::uint64_t before = test::allocations();
  for (int i = 0; i < 200; ++i) {
    plan.stamp = now;
    if (i == 20) input.teleop = nullptr;
    if (i == 80) scan->range_m.fill(0.35F);  // blocked: waits, backs off, turns
    if (i >= 140) put_walker(*scan, 0.05 * i);
    if (i % 10 == 0) ++plan.sequence;
    run(1);
  }
  EXPECT_EQ(test::allocations(), before);
}

TEST_F(ControlStepTest, NeverFasterThanTheLimitsWhateverIsAsked) {
  EXPECT_TRUE(rc::check("any wish", [this](double v, double w) {
    drive.twist = {v, w};
    const auto decision = run(3);
    RC_ASSERT(std::abs(decision.command.twist.v_mps) <= setup.limits.v_max_mps + 1e-9);
    RC_ASSERT(std::abs(decision.command.twist.omega_radps) <= setup.limits.omega_max_radps + 1e-9);
  }));
}

TEST_F(ControlStepTest, BrakesWithTheLeastOfConfigurationAndFirmware) {
  setup.limits.deceleration_mps2 = 0.5;
  input.firmware_deceleration_mps2 = 0.0;
  EXPECT_EQ(limits_now(setup, input).deceleration_mps2, 0.5) << "the firmware told none";
  input.firmware_deceleration_mps2 = 0.3;
  EXPECT_EQ(limits_now(setup, input).deceleration_mps2, 0.3);
  input.firmware_deceleration_mps2 = 2.0;
  EXPECT_EQ(limits_now(setup, input).deceleration_mps2, 0.5);
}

TEST_F(ControlStepTest, ADoubtStopsAndIsReported) {
  run(40);
  ASSERT_EQ(run(1).report.reason, GateReason::kFree);
  state.late = milliseconds(400);
  const ControlOutput out = run(1);
  EXPECT_EQ(out.report.reason, GateReason::kImplausible);
  EXPECT_EQ(out.command.twist, types::Twist2{});
  EXPECT_TRUE(plausibility::has(out.report.plausibility.doubts, plausibility::Doubt::kLateStatuses));
  EXPECT_FALSE(out.command.silence) << "only a base that does not obey is left alone";
}

}  // namespace
}  // namespace topo::pipeline
