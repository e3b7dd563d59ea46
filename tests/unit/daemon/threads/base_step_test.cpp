// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/threads/base_step.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <memory>

namespace topo::daemon {
namespace {

using motion::GateReason;
using std::chrono::milliseconds;

class BaseStepTest : public ::testing::Test {
 protected:
  BaseStepTest() {
    scan->geometry = {-2.356F, 0.004363F, 0.000017F, 0.025F, 0.1F, 30.0F};
    scan->beams = 1081;
    scan->range_m.fill(10.0F);
    scan->first_beam = scan->arrival = now;
    state.arrival = now;
    drive = {now, {0.3, 0.0}};
    input.now = now;
    input.drive = &drive;
    input.state = &state;
    input.front = scan.get();
    input.firmware_watchdog = milliseconds(500);
  }
  /// Some periods of the same input, with everything in it kept fresh.
  BaseDecision run(int periods) {
    BaseDecision decision;
    for (int i = 0; i < periods; ++i) {
      now += milliseconds(50);
      input.now = state.arrival = scan->arrival = scan->first_beam = now;
      if (keep_asking) drive.stamp = now;
      decision = base_step(memory, setup, input);
      input.estop_cleared = false;
    }
    return decision;
  }

  types::Stamp now = types::stamp_from_seconds(100.0);
  std::unique_ptr<types::Scan> scan = std::make_unique<types::Scan>();
  types::BaseState state;
  DriveCommand drive;
  BaseSetup setup;
  BaseInput input;
  BaseMemory memory;
  bool keep_asking = true;
};

TEST_F(BaseStepTest, DrivesAsTheOperatorWants) {
  const auto decision = run(40);
  EXPECT_EQ(decision.reason, GateReason::kFree);
  EXPECT_TRUE(decision.wanted);
  EXPECT_TRUE(decision.command.enable_motors);
  EXPECT_NEAR(decision.command.twist.v_mps, 0.3, 1e-9);
}

TEST_F(BaseStepTest, StandsWithMotorsOffBeforeAnybodyAsks) {
  input.drive = nullptr;
  const auto decision = run(5);
  EXPECT_EQ(decision.command.twist, types::Twist2{});
  EXPECT_FALSE(decision.command.enable_motors);
  EXPECT_FALSE(decision.wanted);
}

TEST_F(BaseStepTest, DeadManStops) {
  run(40);
  keep_asking = false;
  const auto soon = run(6);  // 300 ms
  EXPECT_TRUE(soon.wanted);
  const auto later = run(20);
  EXPECT_FALSE(later.wanted);
  EXPECT_EQ(later.command.twist, types::Twist2{});
  EXPECT_TRUE(later.command.enable_motors);
}

TEST_F(BaseStepTest, EstopLatchesUntilClearedAndThenWantsANewCommand) {
  run(40);
  input.estop = true;
  auto decision = run(1);
  EXPECT_TRUE(decision.command.estop);
  EXPECT_EQ(decision.command.twist, types::Twist2{});
  input.estop = false;
  decision = run(3);
  EXPECT_EQ(decision.reason, GateReason::kEmergencyStop);
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

TEST_F(BaseStepTest, WhateverIsStaleOrMissingStops) {
  const auto stops = [this](auto&& spoil) {
    BaseMemory fresh;
    BaseInput spoiled = input;
    drive.stamp = spoiled.now;
    spoil(spoiled);
    EXPECT_EQ(base_step(fresh, setup, spoiled).command.twist, types::Twist2{});
  };
  run(1);
  stops([](BaseInput& i) { i.state = nullptr; });
  stops([](BaseInput& i) { i.front = nullptr; });
  stops([](BaseInput& i) { i.firmware_watchdog = {}; });
  stops([](BaseInput& i) { i.now += milliseconds(151); });
  stops([](BaseInput& i) { i.estop = true; });
}

TEST_F(BaseStepTest, NeverFasterThanTheLimitsWhateverIsAsked) {
  EXPECT_TRUE(rc::check("any wish", [this](double v, double w) {
    drive.twist = {v, w};
    const auto decision = run(3);
    RC_ASSERT(std::abs(decision.command.twist.v_mps) <= setup.limits.v_max_mps + 1e-9);
    RC_ASSERT(std::abs(decision.command.twist.omega_radps) <= setup.limits.omega_max_radps + 1e-9);
  }));
}

}  // namespace
}  // namespace topo::daemon
