// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/motion/velocity_gate.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <vector>

#include "tests/unit/core/motion/gate_scene.hpp"
#include "tests/unit/core/motion/generators.hpp"

namespace topo::motion {
namespace {

TEST(VelocityGate, GetsUpToSpeedOnTheArcThatWasAskedFor) {
  for (const Twist2 wanted : {Twist2{0.7, -0.15}, {0.3, 0.8}, {-0.08, 0.1}}) {
    Scene scene;
    scene.input.limits.allow_reverse = true;
    for (int i = 0; i < 60; ++i) {
      const Twist2 got = scene.ask(wanted.v_mps, wanted.omega_radps).command.twist;
      EXPECT_NEAR(got.omega_radps * wanted.v_mps, wanted.omega_radps * got.v_mps, 1e-9) << i;
    }
    EXPECT_NEAR(scene.state.last.v_mps, wanted.v_mps, 1e-9);
  }
}

TEST(VelocityGate, LeavesADoorPostBesideItOnAGentleArc) {
  // As it stood for four minutes: a post beside the front, which the arc passes and a turn on the spot does
  // not.
  Scene scene;
  scene.input.T_base_laser = {0.021, 0.0, 0.0};
  const types::Vector2 post{0.16 - 0.021, -0.24};  // 3 cm beside the hull, in the laser's frame
  for (std::size_t i = 0; i < scene.scan->beams; ++i) {
    if (std::abs(static_cast<double>(scene.scan->angle_rad(i)) - std::atan2(post.y(), post.x())) < 0.02)
      scene.scan->range_m[i] = static_cast<float>(post.norm());
  }
  scene.input.limits.footprint = {0.210, 0.301, 0.2125, 0.267};
  for (int i = 0; i < 20; ++i) EXPECT_NE(scene.ask(0.7, -0.15).reason, GateReason::kBlocked) << i;
  EXPECT_GT(scene.state.last.v_mps, 0.05);
}

/// A post beside the circle that the robot turns in, behind it on the left.
void put_post_behind(Scene& scene, double gap_m) {
  scene.input.limits.footprint = {0.210, 0.301, 0.2125, 0.267};
  const double away_m = scene.input.limits.footprint.swing_radius_m + gap_m;
  scene.posts = {{{-away_m * std::cos(0.4), away_m * std::sin(0.4)}, false, true}};
  scene.input.front_points = scene.posts;
}

TEST(VelocityGate, OverSeenGroundItKeepsItsWholeMarginAndLeavesNoTouch) {
  const auto backs = [](Backing backing, const std::function<void(Scene&)>& change) {
    Scene scene;
    put_post_behind(scene, 1.0);
    change(scene);
    scene.input.backing = backing;
    return !stands(scene.settle(-0.03, 0.0));
  };
  const auto nothing = [](Scene&) {};
  const auto touch_ahead = [](Scene& s) { s.base.bumpers_front = 1; };
  const auto post_behind = [](double gap_m) {
    return [gap_m](Scene& s) {
      s.posts.front().p_base = {-s.input.limits.footprint.swing_radius_m - gap_m, 0.0};
    };
  };
  EXPECT_FALSE(backs(Backing::kNone, nothing));
  EXPECT_TRUE(backs(Backing::kAlongTrail, nothing));
  EXPECT_TRUE(backs(Backing::kOverSeenGround, nothing));
  EXPECT_TRUE(backs(Backing::kAlongTrail, touch_ahead));
  EXPECT_FALSE(backs(Backing::kOverSeenGround, touch_ahead));
  const double margin_m = types::RobotLimits{}.margin_m;
  EXPECT_TRUE(backs(Backing::kAlongTrail, post_behind(0.8 * margin_m))) << "where the hull has just been";
  EXPECT_FALSE(backs(Backing::kOverSeenGround, post_behind(0.8 * margin_m)));
  EXPECT_TRUE(backs(Backing::kOverSeenGround, post_behind(margin_m + 0.05)));
}

TEST(VelocityGate, TurnsSlowlyBesideObstaclesDespiteWheelSlip) {
  // Turning at 1.4 rad/s with a post 3 cm behind it, one wheel lost 0.6 of its way: the tail hit the post.
  const auto turns_radps = [](double gap_m) {
    Scene scene;
    put_post_behind(scene, gap_m);
    return scene.settle(0.0, 1.4).command.twist.omega_radps;
  };
  EXPECT_DOUBLE_EQ(turns_radps(0.2), 1.4);
  Scene in_view;
  put_post_behind(in_view, 0.031);
  in_view.posts.front().remembered = false;
  EXPECT_DOUBLE_EQ(in_view.settle(0.0, 1.4).command.twist.omega_radps, 1.4) << "the scanner would tell";
  const types::RobotLimits limits;
  for (const double gap_m : {0.01, 0.02, 0.031, 0.05}) {
    const double aside_m =
        turns_radps(gap_m) * limits.slip_aside_m_per_rad;  // in the second until it is seen
    EXPECT_LT(aside_m, gap_m + 1e-6) << gap_m;
    EXPECT_GT(aside_m, 0.9 * gap_m) << gap_m << ": slower than it has to be";
  }
  EXPECT_NEAR(turns_radps(0.001), limits.omega_beside_radps, 1e-9) << "it has to get away from there";
}

TEST(VelocityGate, PassesAFreeRequest) {
  Scene scene;
  const auto out = scene.settle(0.5, 0.4);
  EXPECT_EQ(out.reason, GateReason::kFree);
  EXPECT_EQ(out.command.twist, (Twist2{0.5, 0.4}));
  EXPECT_TRUE(out.command.enable_motors);
  EXPECT_FALSE(out.command.estop);
}

TEST(VelocityGate, AcceleratesAndBrakesWithinTheLimits) {
  Scene scene;
  double last = scene.ask(0.5).command.twist.v_mps;
  for (int i = 0; i < 100; ++i) {
    const double next = scene.ask(i < 50 ? 0.5 : 0.0).command.twist.v_mps;
    EXPECT_LE(next - last, 0.3 * 0.05 + 1e-9);
    EXPECT_LE(last - next, 0.5 * 0.05 + 1e-9);
    last = next;
  }
  EXPECT_EQ(last, 0.0);
}

TEST(VelocityGate, RampGoesThroughZeroInTwoSteps) {
  EXPECT_EQ(ramped(0.02, -1.0, 0.3, 0.5, 0.05), 0.0);
  EXPECT_EQ(ramped(-0.02, 1.0, 0.3, 0.5, 0.05), 0.0);
  EXPECT_DOUBLE_EQ(ramped(0.0, -1.0, 0.3, 0.5, 0.05), -0.015);
  EXPECT_DOUBLE_EQ(ramped(0.5, 0.0, 0.3, 0.5, 0.05), 0.475);
  EXPECT_EQ(ramped(0.5, 0.6, 0.3, 0.5, 0.0), 0.5);
}

TEST(VelocityGate, ClampingKeepsTheArc) {
  types::RobotLimits limits;
  const Twist2 out = within_limits({1.4, 1.0}, limits);
  EXPECT_DOUBLE_EQ(out.v_mps, 0.7);
  EXPECT_DOUBLE_EQ(out.omega_radps, 0.5);
  EXPECT_DOUBLE_EQ(within_limits({0.5, -14.0}, limits).v_mps, 0.05);
  EXPECT_DOUBLE_EQ(within_limits({-0.5, 0.0}, limits).v_mps, -0.1);
}

TEST(VelocityGate, NeverExceedsTheLimits) {
  EXPECT_TRUE(rc::check([] {
    Scene scene;
    scene.input.limits.allow_reverse = true;
    put_wall_ahead(*scene.scan, uniform(0.3, 5.0));
    const types::RobotLimits& l = scene.input.limits;
    Twist2 last;
    for (int i = 0; i < 60; ++i) {
      const Twist2 t = scene.ask(uniform(-3.0, 3.0), uniform(-5.0, 5.0)).command.twist;
      RC_ASSERT(t.v_mps <= l.v_max_mps + 1e-12 && t.v_mps >= -l.v_reverse_max_mps - 1e-12);
      RC_ASSERT(std::abs(t.omega_radps) <= l.omega_max_radps + 1e-12);
      RC_ASSERT(std::abs(t.v_mps) <= std::abs(last.v_mps) + l.acceleration_mps2 * 0.05 + 1e-9);
      last = t;
    }
  }));
}

TEST(VelocityGate, MoreRoomNeverMeansLessSpeed) {
  EXPECT_TRUE(rc::check([] {
    types::RobotLimits limits;
    const Twist2 t{uniform(-0.7, 0.7), uniform(-1.4, 1.4)};
    const double a = uniform(0.0, 5.0), b = uniform(0.0, 5.0), blind_s = uniform(0.0, 2.5);
    RC_ASSERT(stopping_scale(t, std::min(a, b), blind_s, limits) <=
              stopping_scale(t, std::max(a, b), blind_s, limits));

    Scene near, far;
    const double v_mps = uniform(0.05, 0.7), wall_m = uniform(0.2, 4.0);
    near.settle(v_mps);
    far.settle(v_mps);
    put_wall_ahead(*near.scan, wall_m);
    put_wall_ahead(*far.scan, wall_m + uniform(0.0, 2.0));
    RC_ASSERT(near.ask(v_mps).command.twist.v_mps <= far.ask(v_mps).command.twist.v_mps + 1e-12);
  }));
}

TEST(VelocityGate, StandsBeforeTheWallAlsoWhenTheHostDies) {
  EXPECT_TRUE(rc::check([] {
    Scene scene;
    const double watchdog_s = uniform(0.1, 2.0), wall_m = uniform(0.3, 3.0);
    scene.input.firmware_watchdog = types::from_seconds(watchdog_s);
    double x_m = 0.0;  // the laser sits at the centre of rotation
    for (int i = 0; i < 150; ++i) {
      *scene.scan = *empty_scan(scene.now);
      put_wall_ahead(*scene.scan, wall_m - x_m);
      const double v_mps = scene.ask(0.7).command.twist.v_mps;
      // If nothing is sent from now on: the watchdog's time at this speed, then braking.
      const double front_m = x_m + scene.input.limits.footprint.front_m;
      RC_ASSERT(front_m + v_mps * watchdog_s + v_mps * v_mps / (2.0 * 0.5) < wall_m);
      x_m += v_mps * 0.05;
    }
    RC_ASSERT(wall_m - x_m > 0.21);
  }));
}

TEST(VelocityGate, SlowsThenBlocks) {
  Scene scene;
  scene.settle(0.7);
  put_wall_ahead(*scene.scan, 0.8);
  auto out = scene.ask(0.7);
  EXPECT_EQ(out.reason, GateReason::kSlowed);
  EXPECT_GT(out.command.twist.v_mps, 0.05);
  EXPECT_NEAR(out.free_distance_m, 0.54, 1e-2);
  put_wall_ahead(*scene.scan, 0.262);
  out = scene.ask(0.7);
  EXPECT_EQ(out.reason, GateReason::kBlocked);
  EXPECT_TRUE(stands(out));
  EXPECT_TRUE(out.command.enable_motors);  // they hold the robot
}

TEST(VelocityGate, ReverseIsSlowWhereItIsAllowed) {
  Scene scene;
  scene.input.limits.allow_reverse = true;
  EXPECT_DOUBLE_EQ(scene.settle(-0.5).command.twist.v_mps, -0.1);
}

TEST(VelocityGate, StopsAtTheEdgeOfItsAreaWhenTheHostDies) {
  EXPECT_TRUE(rc::check([] {
    Scene scene;
    types::AreaLimits area;
    area.keep_in = types::Polygon{{-2.0, -2.0}, {2.0, -2.0}, {2.0, 2.0}, {-2.0, 2.0}};
    scene.input.area = &area;
    types::Se2 pose{uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-3.1, 3.1)};
    const double omega_radps = uniform(-0.3, 0.3);
    GateOutput out;
    for (int i = 0; i < 300; ++i) {
      scene.input.T_map_base = pose;
      out = scene.ask(0.7, omega_radps);
      const double v_mps = out.command.twist.v_mps, turn = out.command.twist.omega_radps * 0.05;
      // If nothing is sent from now on: the watchdog's time at this speed, then braking.
      const double rolls_m = v_mps * 0.5 + v_mps * v_mps / (2.0 * scene.input.limits.deceleration_mps2);
      if (omega_radps == 0.0)
        RC_ASSERT(types::intrusion_m(area, pose * types::Se2{rolls_m, 0.0, 0.0},
                                     scene.input.limits.footprint) == 0.0);
      pose =
          pose * types::Se2{v_mps * 0.05 * std::cos(0.5 * turn), v_mps * 0.05 * std::sin(0.5 * turn), turn};
      RC_ASSERT(types::intrusion_m(area, pose, scene.input.limits.footprint) == 0.0);
    }
    if (std::abs(omega_radps) < 0.05) RC_ASSERT(out.reason == GateReason::kAreaLimit);
  }));
}

TEST(VelocityGate, GivesWayToWhatMovesAndGoesOnAfterwards) {
  Scene scene;
  const std::vector<perception::MovingObstacle> comes{{{1.2, 0.0}, {-0.8, 0.0}, 0.2}},
      leaves{{{1.2, 0.0}, {1.0, 0.0}, 0.2}};
  scene.input.moving = comes;
  const GateOutput out = scene.settle(0.5);
  EXPECT_EQ(out.reason, GateReason::kGivesWay);
  EXPECT_TRUE(stands(out));
  EXPECT_TRUE(out.command.enable_motors);
  scene.input.moving = leaves;
  EXPECT_EQ(scene.settle(0.5).reason, GateReason::kFree);
}

TEST(VelocityGate, WhatAppearsTooNearIsBrakedForHardAndNotLatched) {
  const auto estop = [](double measured_mps, double wall_m) {
    Scene scene;
    scene.settle(0.6);
    scene.base.odometry.twist.v_mps = measured_mps;
    put_wall_ahead(*scene.scan, wall_m);
    const GateOutput out = scene.ask(0.6);
    EXPECT_TRUE(!out.command.estop || (stands(out) && out.reason == GateReason::kBlocked));
    EXPECT_FALSE(scene.state.estop_latched);
    return out.command.estop;
  };
  EXPECT_TRUE(estop(0.6, 0.5));
  EXPECT_FALSE(estop(0.6, 1.2)) << "normal braking is enough";
  EXPECT_FALSE(estop(0.05, 0.3)) << "it hardly drives";
  EXPECT_FALSE(estop(-0.6, 0.3)) << "backwards";
  bool before = true;
  for (double wall_m = 0.25; wall_m < 2.0; wall_m += 0.05) {
    const bool now = estop(0.6, wall_m);
    EXPECT_TRUE(before || !now) << "farther is no worse: " << wall_m;
    before = now;
  }
}

TEST(VelocityGate, ATouchBehindIsLeftStraightForwardsByHandAlone) {
  const auto ask = [](bool by_hand, bool front, double v_mps) {
    Scene scene;
    scene.base.bumpers_rear = 2;
    scene.base.bumpers_front = front ? 1 : 0;
    scene.input.by_hand = by_hand;
    scene.input.limits.allow_reverse = true;
    return scene.settle(v_mps, 0.5);
  };
  const GateOutput creeps = ask(true, false, 0.5);
  EXPECT_DOUBLE_EQ(creeps.command.twist.v_mps, types::RobotLimits{}.v_reverse_max_mps);
  EXPECT_EQ(creeps.command.twist.omega_radps, 0.0);
  EXPECT_EQ(creeps.reason, GateReason::kLimited);
  for (const GateOutput& out :
       {ask(false, false, 0.5), ask(true, true, 0.5), ask(true, false, 0.0), ask(true, false, -0.1)}) {
    EXPECT_EQ(out.reason, GateReason::kBumper);
    EXPECT_TRUE(stands(out));
  }
}

TEST(VelocityGate, BesideThingsAWheelThatMaySlipSlowsIt) {
  const auto speed_mps = [](double slip_curvature, double gap_m) {
    Scene scene;
    scene.input.limits.slip_curvature_per_m = slip_curvature;
    for (double x = 0.3; x < 1.5; x += 0.02)
      scene.posts.push_back({{x, scene.input.limits.footprint.half_width_m + gap_m}, true, false});
    scene.input.front_points = scene.posts;
    return scene.settle(0.7).command.twist.v_mps;
  };
  const double beside_mps = types::RobotLimits{}.v_beside_mps;
  EXPECT_DOUBLE_EQ(speed_mps(0.0, 0.1), 0.7);
  EXPECT_LE(speed_mps(1.7, 0.1), speed_mps(0.5, 0.1));
  EXPECT_LT(speed_mps(1.7, 0.1), 0.6);
  for (const double slip : {0.5, 1.7, 3.0, 5.0}) {
    for (const double gap_m : {0.055, 0.1, 0.3}) EXPECT_GE(speed_mps(slip, gap_m), beside_mps - 1e-9) << slip;
  }
  EXPECT_GE(speed_mps(1.7, 0.3), speed_mps(1.7, 0.1));
}

TEST(VelocityGate, MoreThanTheRobotCanIsLimited) {
  Scene scene;
  const GateOutput out = scene.settle(1.4, 1.0);
  EXPECT_EQ(out.reason, GateReason::kLimited);
  EXPECT_EQ(out.command.twist, (Twist2{0.7, 0.5}));
  EXPECT_EQ(scene.settle(0.7, 0.5).reason, GateReason::kFree);
}

TEST(VelocityGate, ALatePeriodIsNoJumpAndAnEarlyOneNoStep) {
  Scene scene;
  scene.ask(0.7);
  const double before_mps = scene.state.last.v_mps;
  scene.now += std::chrono::seconds(3);
  EXPECT_NEAR(scene.ask(0.7).command.twist.v_mps, before_mps + 0.3 * 0.1, 1e-12)
      << "a tenth of a second counts";
  const double then_mps = scene.state.last.v_mps;
  EXPECT_EQ(scene.again().command.twist.v_mps, then_mps) << "no time has passed";
  scene.now -= std::chrono::seconds(1);
  EXPECT_EQ(scene.ask(0.7).command.twist.v_mps, then_mps) << "time does not run backwards";
}

TEST(VelocityGate, MotorsAreOnWhenAFreshRequestSaysSo) {
  Scene scene;
  EXPECT_TRUE(scene.ask(0.0).command.enable_motors);
  scene.input.request.stamp = scene.now - milliseconds(301);
  EXPECT_FALSE(scene.again().command.enable_motors);
  scene.input.request.enable_motors = false;
  EXPECT_FALSE(scene.ask(0.0).command.enable_motors);
  scene.input.request.enable_motors = true;
  scene.base.bumpers_front = 1;
  EXPECT_TRUE(scene.ask(0.5).command.enable_motors) << "they hold the robot";
}

TEST(VelocityGate, BlindTimeIsOfTheScanTheReactionAndTheWatchdog) {
  Scene scene;
  const double alive_s = 0.045 + 0.1 + 0.05;  // the first beam, the reaction, a period
  EXPECT_NEAR(alive_time_s(scene.input), alive_s, 1e-9);
  EXPECT_NEAR(blind_time_s(scene.input), alive_s + 0.5 - 0.05, 1e-9);
  scene.scan->first_beam = scene.now + milliseconds(500);
  EXPECT_NEAR(alive_time_s(scene.input), 0.02 + 0.15, 1e-9) << "by the arrival";
  scene.scan->arrival = scene.now + milliseconds(500);
  EXPECT_NEAR(alive_time_s(scene.input), 0.15, 1e-9) << "never negative";
  scene.scan->first_beam = Stamp{};
  EXPECT_NEAR(alive_time_s(scene.input), 1.0 + 0.15, 1e-9) << "a second at most";
}

TEST(VelocityGate, LimitedTwistsStayOnTheirArcAndAreLimitedOnce) {
  EXPECT_TRUE(rc::check([] {
    const types::RobotLimits limits;
    const Twist2 t{uniform(-3.0, 3.0), uniform(-5.0, 5.0)}, out = within_limits(t, limits);
    const Twist2 twice = within_limits(out, limits);
    RC_ASSERT(std::abs(out.v_mps * t.omega_radps - out.omega_radps * t.v_mps) < 1e-9);
    RC_ASSERT(out.v_mps * t.v_mps >= 0.0);
    RC_ASSERT(out.omega_radps * t.omega_radps >= 0.0);
    RC_ASSERT(std::abs(twice.v_mps - out.v_mps) < 1e-12);
    RC_ASSERT(std::abs(twice.omega_radps - out.omega_radps) < 1e-12);
    const Twist2 mirrored = within_limits({t.v_mps, -t.omega_radps}, limits);
    RC_ASSERT(mirrored == (Twist2{out.v_mps, -out.omega_radps}));
    const bool fits = t.v_mps <= 0.7 && t.v_mps >= -0.1 && std::abs(t.omega_radps) <= 1.4;
    RC_ASSERT((out == t) == fits);
  }));
}

TEST(VelocityGate, ARampNeverOvershootsAndArrives) {
  EXPECT_TRUE(rc::check([] {
    const double wanted = uniform(-1.0, 1.0), faster = uniform(0.1, 2.0), slower = uniform(0.1, 2.0);
    double now = uniform(-1.0, 1.0);
    for (int i = 0; i < 500 && now != wanted; ++i) {
      const double next = ramped(now, wanted, faster, slower, 0.05);
      RC_ASSERT(ramped(-now, -wanted, faster, slower, 0.05) == -next);
      RC_ASSERT(std::abs(next - wanted) <= std::abs(now - wanted));
      RC_ASSERT((next - wanted) * (now - wanted) >= 0.0);
      RC_ASSERT(now * next >= 0.0);  // through 0 in two steps
      const bool speeds_up = std::abs(next) > std::abs(now);
      RC_ASSERT(std::abs(next - now) <= (speeds_up ? faster : slower) * 0.05 + 1e-12);
      now = next;
    }
    RC_ASSERT(now == wanted);
  }));
}

TEST(VelocityGate, TheStoppingScaleUsesTheFreeTimeUp) {
  EXPECT_TRUE(rc::check([] {
    const types::RobotLimits l;
    const Twist2 t{uniform(-0.7, 0.7), uniform(-1.4, 1.4)};
    const double free_s = uniform(0.0, 5.0), blind_s = uniform(0.0, 2.5);
    const double scale = stopping_scale(t, free_s, blind_s, l);
    const double braking_s = std::max(std::abs(t.v_mps) / (2.0 * l.deceleration_mps2),
                                      std::abs(t.omega_radps) / (2.0 * l.angular_acceleration_radps2));
    RC_ASSERT((scale >= 0.0 && scale <= 1.0));
    if (scale < 1.0)
      RC_ASSERT(std::abs(scale * (blind_s + scale * braking_s) - free_s) < 1e-9);
    else
      RC_ASSERT(blind_s + braking_s <= free_s + 1e-9);
    RC_ASSERT(stopping_scale(t, free_s, blind_s + 0.1, l) <= scale);
  }));
  EXPECT_EQ(stopping_scale({0.5, 0.0}, std::numeric_limits<double>::quiet_NaN(), 0.5, {}), 0.0);
  EXPECT_EQ(stopping_scale({0.5, 0.0}, -1.0, 0.5, {}), 0.0);
  EXPECT_EQ(stopping_scale({0.5, 0.0}, HUGE_VAL, 0.5, {}), 1.0);
}

}  // namespace
}  // namespace topo::motion
