// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <tuple>
#include <vector>

#include "drivers/pioneer/connection.hpp"
#include "tests/unit/drivers/pioneer/scripted_robot.hpp"

namespace topo::pioneer {

// Commands by their numbers in the protocol.
inline constexpr int kSync0 = 0, kOpen = 1, kClose = 2, kEnable = 4, kSetV = 6, kVel = 11, kConfig = 18,
                     kRvel = 21, kEncoder = 19, kEStop = 55, kPulse = 0;

class PioneerSession : public testing::Test {
 protected:
  ScriptedRobot robot;
  ConnectionConfig config;
  std::unique_ptr<Connection> connection;
  types::BaseState state;
  std::vector<Health> changes;
  int states = 0;

  void start() {
    connection = std::make_unique<Connection>(config, std::make_unique<ScriptedConnector>(robot));
  }

  void step(types::Duration timeout = std::chrono::milliseconds(20)) {
    const types::Stamp before = robot.now;
    const auto outcome = connection->step(state, timeout);
    EXPECT_LE(robot.now - before, timeout + std::chrono::milliseconds(1));
    if (outcome == StepOutcome::kChanged) changes.push_back(connection->health());
    if (outcome == StepOutcome::kState) ++states;
  }
  void run(types::Duration duration) {
    for (const types::Stamp end = robot.now + duration; robot.now < end;) step();
  }
  bool run_until(Health wanted, types::Duration limit = std::chrono::milliseconds(20000)) {
    for (const types::Stamp end = robot.now + limit; robot.now < end && connection->health() != wanted;)
      step();
    return connection->health() == wanted;
  }
  /// As the base thread: a command every 50 ms.
  void drive(const types::BaseCommand& command, types::Duration duration) {
    for (const types::Stamp end = robot.now + duration; robot.now < end;) {
      std::ignore = connection->command(command);
      for (const types::Stamp period = robot.now + std::chrono::milliseconds(50); robot.now < period;)
        step(period - robot.now);
    }
  }
  void connect() {
    start();
    ASSERT_TRUE(run_until(Health::kReady)) << connection->message();
    run(std::chrono::milliseconds(200));
  }
  static types::BaseCommand move(double v_mps, double omega_radps = 0.0) {
    return {.twist = {v_mps, omega_radps}, .enable_motors = true, .estop = false};
  }
};

}  // namespace topo::pioneer
