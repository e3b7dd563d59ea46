// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <rapidcheck.h>

#include <cmath>
#include <limits>

#include "core/pipeline/control_evidence.hpp"
#include "core/pipeline/plan_following.hpp"
#include "tests/unit/core/pipeline/control_scene.hpp"
#include "tests/unit/support/allocation_counter.hpp"

namespace topo::pipeline {
namespace {

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

TEST(PlanFollowing, LooksAsFarAsItsSpeedNeedsWithRoomForAllOfAScan) {
  constexpr double kBlind_s = 2.26, kScan_rad = 1.5 * M_PI;
  types::RobotLimits limits;
  EXPECT_EQ(obstacle_reach(limits, kBlind_s, {}).reach_m, PlanFollowingParams{}.obstacle_reach_m);
  EXPECT_EQ(obstacle_reach(limits, kBlind_s, {}).spacing_m, PlanFollowingParams{}.obstacle_spacing_m);
  for (const double v_mps : {0.3, 0.7, 0.9, 1.2, 2.0}) {
    limits.v_max_mps = v_mps;
    const ObstacleReach reach = obstacle_reach(limits, kBlind_s, {});
    const double stops_m = v_mps * kBlind_s + v_mps * v_mps / (2.0 * limits.deceleration_mps2);
    EXPECT_GT(reach.reach_m, stops_m + limits.footprint.front_m) << v_mps;
    EXPECT_LT(kScan_rad * reach.reach_m / reach.spacing_m, motion::PathFollower::kMaxObstacles) << v_mps;
  }
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
  // A robot under way: one that stands would be told to stand whatever the input is.
  const auto stops = [this](GateReason reason, auto&& spoil) {
    ASSERT_GT(run(60).command.twist.v_mps, 0.2);
    ControlOutput out;
    for (int i = 0; i < 20; ++i) {
      now += milliseconds(50);
      input.now = state.arrival = scan->arrival = scan->first_beam = drive.stamp = now;
      ControlInput spoiled = input;
      spoil(spoiled);
      out = control_step(memory, setup, spoiled);
      EXPECT_EQ(out.report.reason, reason) << "after " << i + 1 << " periods";
    }
    EXPECT_EQ(out.command.twist, types::Twist2{});
  };
  stops(GateReason::kStaleStatus, [](ControlInput& i) { i.state = nullptr; });
  stops(GateReason::kStaleScan, [](ControlInput& i) { i.front = nullptr; });
  stops(GateReason::kNoWatchdog, [](ControlInput& i) { i.firmware_watchdog = {}; });
  stops(GateReason::kStaleScan, [](ControlInput& i) { i.now += milliseconds(151); });
  stops(GateReason::kStaleStatus, [](ControlInput& i) { i.now += milliseconds(1001); });
  stops(GateReason::kEmergencyStop, [](ControlInput& i) { i.estop = true; });
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

TEST_F(ControlStepTest, TurnsAsPlannedAndReportsTheHeading) {
  input.teleop = nullptr;
  Plan plan;
  plan.moving = plan.located = true;
  plan.goal_id = 7;
  plan.turn_to_rad = 3.0;
  input.plan = &plan;
  double theta_rad = 0.0;
  ControlReport report;
  for (int i = 0; i < 400 && report.mode != ControlMode::kArrived; ++i) {
    plan.stamp = now;
    state.odometry.T_odom_base = {0.0, 0.0, theta_rad};
    const ControlOutput out = run(1);
    report = out.report;
    EXPECT_EQ(out.command.twist.v_mps, 0.0);
    theta_rad += 0.05 * out.command.twist.omega_radps;
  }
  EXPECT_EQ(report.mode, ControlMode::kArrived);
  EXPECT_EQ(report.goal_id, 7U);
  EXPECT_NEAR(theta_rad, 3.0, 0.3);
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

TEST_F(ControlStepTest, AnAreaThatIsDrawnStopsTheRobotBeforeIt) {
  Plan plan = plan_ahead(now);
  input.plan = &plan;
  const auto fresh = [&] { return plan.stamp = now, run(1); };
  for (int i = 0; i < 10; ++i) fresh();
  EXPECT_GT(fresh().command.twist.v_mps, 0.0);
  types::AreaLimits drawn;
  const double edge_m = setup.limits.footprint.front_m + setup.limits.margin_m + 0.005;
  drawn.keep_out = {{{edge_m, -1.0}, {edge_m + 1.0, -1.0}, {edge_m + 1.0, 1.0}, {edge_m, 1.0}}};
  input.area = &drawn;
  for (int i = 0; i < 30; ++i) fresh();
  EXPECT_EQ(fresh().report.reason, GateReason::kAreaLimit);
  EXPECT_EQ(fresh().command.twist.v_mps, 0.0);
  drawn.keep_out.clear();
  for (int i = 0; i < 10; ++i) fresh();
  EXPECT_GT(fresh().command.twist.v_mps, 0.0) << "withdrawn";
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
