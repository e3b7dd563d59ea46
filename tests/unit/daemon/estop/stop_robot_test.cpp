// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/estop/stop_robot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/drivers/pioneer/scripted_robot.hpp"

namespace topo::daemon {
namespace {

using pioneer::Received;
using pioneer::ScriptedRobot;
using std::chrono::milliseconds;
using testing::Each;
using testing::ElementsAre;
using testing::Field;
using types::Errc;

constexpr int kEStop = 55, kVel = 11, kRvel = 21, kClose = 2;

/// Driving at its last setpoint, its host gone a moment ago.
void drive(ScriptedRobot& robot) {
  robot.open = robot.motors = true;
  robot.setpoint_mmps = robot.velocity_mmps = 500;
}

types::Result<StopOutcome> stop(ScriptedRobot& robot) {
  pioneer::ScriptedConnector connector(robot);
  return stop_robot(connector);
}

class BusyConnector final : public io::Connector {
 public:
  BusyConnector(ScriptedRobot& robot, int refusals) : inner_(robot), refusals_(refusals) {}
  types::Result<std::unique_ptr<io::ByteStream>> connect(types::Duration timeout) override {
    if (refusals_-- > 0) return types::fail(Errc::kBusy, "held by the daemon that is just dying");
    return inner_.connect(timeout);
  }
  [[nodiscard]] std::string_view name() const override { return inner_.name(); }
  [[nodiscard]] types::Stamp now() const override { return inner_.now(); }
  void pause(types::Duration duration) override { inner_.pause(duration); }

 private:
  pioneer::ScriptedConnector inner_;
  int refusals_;
};

TEST(StopRobot, WritesTheFirstBytesOfTheDesignInTheirOrder) {
  ScriptedRobot robot;
  drive(robot);
  const auto outcome = stop(robot);
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_EQ(*outcome, StopOutcome::kStands);
  EXPECT_THAT(robot.commands(), ElementsAre(kEStop, kVel, kRvel, kClose));
  EXPECT_TRUE(robot.last(kClose)->has_argument);
  EXPECT_THAT(robot.received, Each(Field(&Received::argument, testing::Le(1))));
  EXPECT_FALSE(robot.open || robot.motors);
  EXPECT_EQ(robot.velocity_mmps, 0);
}

TEST(StopRobot, DoesTheSameEveryTime) {
  ScriptedRobot robot;
  drive(robot);
  ASSERT_TRUE(stop(robot));
  robot.forget();
  const auto again = stop(robot);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(*again, StopOutcome::kSilent);
  EXPECT_THAT(robot.commands(), ElementsAre(kEStop, kVel, kRvel, kClose));
}

class StopRobotAtSpeed : public testing::TestWithParam<int> {};

TEST_P(StopRobotAtSpeed, FindsTheLinesSpeed) {
  ScriptedRobot robot;
  robot.has_baud = true;
  robot.baud = GetParam();
  drive(robot);
  const types::Stamp begin = robot.now;
  const auto outcome = stop(robot);
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_EQ(robot.velocity_mmps, 0);
  EXPECT_FALSE(robot.open);
  EXPECT_LT(robot.now - begin, kStopLimit);
}

INSTANTIATE_TEST_SUITE_P(Speeds, StopRobotAtSpeed, testing::Values(9600, 19200, 38400, 57600, 115200));

TEST(StopRobot, TriesFirstTheSpeedThatTheDaemonLeftTheLineWith) {
  ScriptedRobot robot;
  robot.has_baud = true;
  robot.baud = robot.baud_of_host = 57600;
  drive(robot);
  const auto outcome = stop(robot);
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_EQ(*outcome, StopOutcome::kStands);
  EXPECT_THAT(robot.received, Each(Field(&Received::baud, 57600)));
  EXPECT_EQ(robot.baud_of_host, 57600);
}

TEST(StopRobot, ARobotThatIsOffIsNoFailureWithinASecond) {
  ScriptedRobot robot;
  robot.powered = false;
  robot.has_baud = true;
  const types::Stamp begin = robot.now;
  const auto outcome = stop(robot);
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_EQ(*outcome, StopOutcome::kSilent);
  EXPECT_LE(robot.now - begin, kStopLimit);
}

TEST(StopRobot, APortThatIsNotThereIsReportedAtOnce) {
  ScriptedRobot robot;
  robot.port_exists = false;
  const types::Stamp begin = robot.now;
  const auto outcome = stop(robot);
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().code, Errc::kNotFound);
  EXPECT_EQ(robot.now, begin);
}

TEST(StopRobot, WaitsForAPortThatIsNotLetGoYet) {
  ScriptedRobot robot;
  drive(robot);
  BusyConnector connector(robot, 5);
  const auto outcome = stop_robot(connector);
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_EQ(robot.velocity_mmps, 0);
}

TEST(StopRobot, GivesUpOnAPortThatStaysHeld) {
  ScriptedRobot robot;
  drive(robot);
  BusyConnector connector(robot, 1'000'000);
  const types::Stamp begin = robot.now;
  const auto outcome = stop_robot(connector);
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().code, Errc::kBusy);
  EXPECT_LE(robot.now - begin, kStopLimit);
}

TEST(StopRobot, SaysWhenTheWheelsStillTurn) {
  ScriptedRobot robot;
  drive(robot);
  robot.chatter = " ";           // nothing that is written arrives, and the reports go on
  robot.config.watchdog_ms = 0;  // nobody else stops it
  const types::Stamp begin = robot.now;
  const auto outcome = stop(robot);
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_EQ(*outcome, StopOutcome::kMoves);
  EXPECT_LE(robot.now - begin, kStopLimit);
}

}  // namespace
}  // namespace topo::daemon
