// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// How control frees a robot that something blocks; control_step_test.cpp has what it decides otherwise.
#include <cmath>

#include "tests/unit/core/pipeline/control_scene.hpp"

namespace topo::pipeline {
namespace {

using ControlRecoveryTest = ControlStepTest;

TEST_F(ControlRecoveryTest, BacksOffFromWhatBlocksItButNotIntoAMate) {
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
TEST_F(ControlRecoveryTest, BacksOffAlongItsTrailThoughTheOdometryHasDrifted) {
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

TEST_F(ControlRecoveryTest, EveryTouchIsCountedOnceWithItsPlace) {
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

TEST_F(ControlRecoveryTest, OnlyManualControlCreepsOffAPressedRearBumper) {
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

TEST_F(ControlRecoveryTest, DoesNotSwingItsTailAgainstWhatItHasDrivenPast) {
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

/// As robots stood until the exploration was over: it came along x and turned by 1.2 rad, and now there is a
/// jamb 0.27 m ahead, within the circle that it turns in; the path leads away from it, the trail lies aside.
TEST_F(ControlRecoveryTest, AStuckRobotEasesBackOverSeenGroundNotIntoAMate) {
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

TEST_F(ControlRecoveryTest, WaitsForAWalkerUntilPatienceEnds) {
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

}  // namespace
}  // namespace topo::pipeline
