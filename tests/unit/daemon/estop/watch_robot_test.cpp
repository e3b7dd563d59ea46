// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/estop/watch_robot.hpp"

#include <gmock/gmock.h>

#include "tests/unit/drivers/pioneer/scripted_robot.hpp"

namespace topo::daemon {
namespace {

using pioneer::ScriptedRobot;

types::Result<StopOutcome> watch(ScriptedRobot& robot) {
  pioneer::ScriptedConnector connector(robot);
  return watch_robot(connector);
}

TEST(WatchRobot, WritesNothingAndTellsWhatItHears) {
  ScriptedRobot robot;
  robot.open = robot.motors = true;
  robot.velocity_mmps = robot.setpoint_mmps = 300;
  robot.config.watchdog_ms = 0;  // drives for ever
  const types::Stamp begin = robot.now;
  auto outcome = watch(robot);
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_EQ(*outcome, StopOutcome::kMoves);
  EXPECT_LE(robot.now - begin, kStopLimit + std::chrono::milliseconds(1));
  robot.velocity_mmps = 0;
  outcome = watch(robot);
  ASSERT_TRUE(outcome);
  EXPECT_EQ(*outcome, StopOutcome::kStands);
  robot.sends_status = false;
  outcome = watch(robot);
  ASSERT_TRUE(outcome);
  EXPECT_EQ(*outcome, StopOutcome::kSilent);
  EXPECT_TRUE(robot.received.empty());
}

TEST(WatchRobot, APortThatIsGoneIsAnError) {
  ScriptedRobot robot;
  robot.port_exists = false;
  const auto outcome = watch(robot);
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().code, types::Errc::kNotFound);
}

}  // namespace
}  // namespace topo::daemon
