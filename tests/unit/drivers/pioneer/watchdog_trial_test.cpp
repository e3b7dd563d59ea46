// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// A firmware that does not tell its watchdog: what is given in the configuration is measured before driving.
#include "drivers/pioneer/watchdog_trial.hpp"

#include <gmock/gmock.h>

#include "tests/unit/drivers/pioneer/connection_fixture.hpp"

namespace topo::pioneer {
namespace {

using std::chrono::milliseconds;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

struct PioneerWatchdog : PioneerSession {
  PioneerWatchdog() { robot.config.watchdog_ms = 1000; }
  /// To the silence of the trial: the wheels turn, and nothing was sent for 200 ms.
  void turn_into_silence() {
    config.watchdog_ms = 1000;
    robot.damages_config = true;
    start();
    ASSERT_TRUE(run_until(Health::kOnTrial)) << connection->message();
    drive(move(0.0, 0.2), milliseconds(900));
    ASSERT_EQ(robot.rotation_degps, 11);
    const std::size_t heard = robot.received.size();
    drive(move(0.0, 0.2), milliseconds(200));
    ASSERT_EQ(robot.received.size(), heard);
  }
};

TEST_F(PioneerWatchdog, ADamagedConfigPacketIsToldAsSuch) {
  robot.damages_config = true;
  start();
  ASSERT_TRUE(run_until(Health::kUnsafe));
  EXPECT_THAT(connection->message(), AllOf(HasSubstr("its CONFIG packet came damaged (3 times)"),
                                           HasSubstr("base.watchdog_ms"), Not(HasSubstr("sent no"))));
  EXPECT_LE(connection->message().size(), 240U);
  EXPECT_FALSE(connection->command(move(0.1)));
  EXPECT_EQ(robot.largest_motion_mmps, 0);
}

TEST_F(PioneerWatchdog, SoIsOneThatIsCutShort) {
  robot.cuts_config = true;
  start();
  ASSERT_TRUE(run_until(Health::kUnsafe));
  EXPECT_THAT(connection->message(), HasSubstr("its CONFIG packet came damaged (3 times)"));
}

TEST_F(PioneerWatchdog, NoneAndZeroAreToldApartFromIt) {
  robot.answers_config = false;
  start();
  ASSERT_TRUE(run_until(Health::kUnsafe));
  EXPECT_THAT(connection->message(), HasSubstr("the robot sent no CONFIG packet"));
  connection.reset();
  robot.answers_config = true;
  robot.config.watchdog_ms = 0;
  start();
  ASSERT_TRUE(run_until(Health::kUnsafe));
  EXPECT_THAT(connection->message(), HasSubstr("off or not reported (WatchDog 0)"));
}

TEST_F(PioneerWatchdog, ADamagedPacketDoesNotIdentifyTheRobot) {
  robot.damages_config = true;
  config.watchdog_ms = 1000;
  config.expected_serial_number = "SN123";
  start();
  ASSERT_TRUE(run_until(Health::kUnidentified));
  EXPECT_THAT(connection->message(), AllOf(HasSubstr("came damaged (3 times); expected \"SN123\""),
                                           HasSubstr("leave base.serial_number out")));
}

TEST_F(PioneerWatchdog, WhatTheFirmwareTellsHoldsAgainstTheConfiguration) {
  config.watchdog_ms = 500;
  connect();
  EXPECT_EQ(connection->info()->watchdog_ms, 1000);
  EXPECT_EQ(connection->info()->watchdog, WatchdogSource::kTold);
  connection.reset();
  robot.config.watchdog_ms = 3000;
  start();
  ASSERT_TRUE(run_until(Health::kUnsafe));
  EXPECT_THAT(connection->message(), HasSubstr("takes 3000 ms"));
}

TEST_F(PioneerWatchdog, BeforeTheMeasurementNothingDrivesForward) {
  config.watchdog_ms = 1000;
  robot.damages_config = true;
  start();
  ASSERT_TRUE(run_until(Health::kOnTrial)) << connection->message();
  EXPECT_THAT(connection->message(), AllOf(HasSubstr("sends damaged CONFIG packets"),
                                           HasSubstr("base.watchdog_ms = 1000"), HasSubstr("topoctl drive")));
  drive(move(0.2), milliseconds(2000));
  drive(move(0.2, 0.2), milliseconds(2000));
  EXPECT_EQ(robot.largest_motion_mmps, 0);
  EXPECT_EQ(connection->health(), Health::kOnTrial);
}

TEST_F(PioneerWatchdog, ATurnMeasuresItAndTheRobotIsReady) {
  turn_into_silence();
  drive(move(0.0, 0.2), milliseconds(1500));
  ASSERT_EQ(connection->health(), Health::kReady) << connection->message();
  EXPECT_THAT(connection->message(), HasSubstr("watchdog 1000 ms (base.watchdog_ms, measured)"));
  EXPECT_EQ(connection->info()->watchdog, WatchdogSource::kMeasured);
  EXPECT_EQ(robot.rotation_degps, 11) << "the operator's turn goes on";
  drive(move(0.2), milliseconds(1000));
  EXPECT_EQ(robot.velocity_mmps, 200);
}

TEST_F(PioneerWatchdog, ItIsMeasuredOnce) {
  turn_into_silence();
  drive(move(0.0, 0.2), milliseconds(1500));
  ASSERT_EQ(connection->health(), Health::kReady);
  drive({.twist = {0.0, 0.0}, .enable_motors = false, .estop = false}, milliseconds(1000));
  robot.cut = true;
  run(milliseconds(100));
  ASSERT_TRUE(run_until(Health::kReady)) << connection->message();
  connection.reset();
  start();
  EXPECT_TRUE(run_until(Health::kOnTrial)) << "another program's measurement is not known";
}

TEST_F(PioneerWatchdog, WheelsThatTurnOnAreStoppedAndDrivingRefused) {
  robot.config.watchdog_ms = 0;  // off: nothing stops them
  turn_into_silence();
  drive(move(0.0, 0.2), milliseconds(1600));
  EXPECT_EQ(connection->health(), Health::kUnsafe);
  EXPECT_THAT(connection->message(), HasSubstr("the wheels turned on 1000 ms and more"));
  EXPECT_EQ(robot.rotation_degps, 0);
  robot.largest_motion_mmps = 0;
  drive(move(0.2, 0.2), milliseconds(2000));
  EXPECT_EQ(robot.largest_motion_mmps, 0);
  EXPECT_EQ(robot.rotation_degps, 0);
}

TEST_F(PioneerWatchdog, AStopIsObeyedDuringTheSilence) {
  for (const bool estop : {false, true}) {
    turn_into_silence();
    drive({.twist = {0.0, 0.0}, .enable_motors = true, .estop = estop}, milliseconds(60));
    EXPECT_EQ(robot.rotation_degps, 0) << estop;
    EXPECT_EQ(connection->health(), Health::kOnTrial);
    connection.reset();
    robot.forget();
  }
}

TEST_F(PioneerWatchdog, ACallerThatFallsSilentStopsTheRobot) {
  turn_into_silence();
  run(milliseconds(300));
  EXPECT_EQ(robot.rotation_degps, 0);
  EXPECT_EQ(connection->health(), Health::kOnTrial);
}

TEST_F(PioneerWatchdog, ARobotThatIsNotHeardIsStopped) {
  turn_into_silence();
  robot.sends_status = false;
  drive(move(0.0, 0.2), milliseconds(400));
  EXPECT_GE(robot.count(kEStop), 1);
  EXPECT_NE(connection->health(), Health::kReady);
}

TEST_F(PioneerWatchdog, AStallOrAContactIsNoMeasurement) {
  turn_into_silence();
  robot.stall_bump = 1;
  robot.velocity_mmps = robot.rotation_degps = 0;
  drive(move(0.0, 0.2), milliseconds(300));
  EXPECT_EQ(connection->health(), Health::kOnTrial);
}

}  // namespace
}  // namespace topo::pioneer
