// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// What a connection does with commands and status; connection_connect_test.cpp has how it comes about and
// ends.
#include "tests/unit/drivers/pioneer/connection_fixture.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "tests/unit/support/allocation_counter.hpp"

namespace topo::pioneer {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using types::BaseCommand;

TEST_F(PioneerSession, LeavesTimeBetweenCommands) {
  connect();
  drive(move(0.2, 0.1), milliseconds(1000));
  for (std::size_t i = 1; i < robot.received.size(); ++i)
    EXPECT_GE(robot.received[i].stamp - robot.received[i - 1].stamp, milliseconds(4)) << i;
}

TEST_F(PioneerSession, EnablesMotorsOnlyOnRequest) {
  connect();
  run(milliseconds(1000));
  EXPECT_EQ(robot.count(kEnable), 0);
  drive(move(0.0), milliseconds(300));
  EXPECT_TRUE(robot.motors);
  EXPECT_TRUE(state.motors_enabled);
  EXPECT_EQ(robot.count(kEnable), 1);
}

TEST_F(PioneerSession, DrivesAndReportsInSi) {
  connect();
  drive(move(0.25), milliseconds(2000));
  EXPECT_EQ(robot.velocity_mmps, 250);
  EXPECT_DOUBLE_EQ(state.odometry.twist.v_mps, 0.25);
  EXPECT_NEAR(state.odometry.T_odom_base.x_m(), robot.x_mm * 1e-3, 0.03);
  EXPECT_GT(state.odometry.T_odom_base.x_m(), 0.3);
  EXPECT_FLOAT_EQ(state.sonar[2].range_m, 1.234F);
  EXPECT_FLOAT_EQ(state.battery_v, 12.7F);
  EXPECT_EQ(state.sequence, connection->counters().status_packets);
  EXPECT_LE(state.odometry.stamp, state.arrival);
}

TEST_F(PioneerSession, ClampsAndQuantises) {
  config.v_max_mps = 0.5;
  config.omega_max_radps = 1.0;
  connect();
  drive(move(3.0, -9.0), milliseconds(300));
  EXPECT_EQ(robot.last(kVel)->argument, 500);
  EXPECT_EQ(robot.last(kRvel)->argument, -57);
  drive(move(-0.1234, 0.008), milliseconds(100));
  EXPECT_EQ(robot.last(kVel)->argument, -123);
  EXPECT_EQ(robot.last(kRvel)->argument, 0);  // below half a degree a second
}

TEST_F(PioneerSession, ACommandThatIsNotFiniteIsAStop) {
  connect();
  drive(move(0.3, 0.3), milliseconds(500));
  ASSERT_EQ(robot.velocity_mmps, 300);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    drive(move(0.2), milliseconds(100));
    drive(move(bad, 0.2), milliseconds(100));
    EXPECT_EQ(robot.velocity_mmps, 0);
    EXPECT_EQ(robot.rotation_degps, 0);
    drive(move(0.2, bad), milliseconds(100));
    EXPECT_EQ(robot.velocity_mmps, 0);
  }
}

TEST_F(PioneerSession, ASilentCallerStopsTheRobot) {
  connect();
  drive(move(0.3), milliseconds(1000));
  ASSERT_EQ(robot.velocity_mmps, 300);
  robot.forget();
  run(milliseconds(260));
  EXPECT_EQ(robot.velocity_mmps, 0);
  ASSERT_NE(robot.last(kVel), nullptr);
  EXPECT_EQ(robot.last(kVel)->argument, 0);
  robot.forget();
  run(milliseconds(3000));  // and keeps the connection alive
  EXPECT_GE(robot.count(kPulse) + robot.count(kEncoder), 4);
  EXPECT_EQ(connection->health(), Health::kReady);
}

TEST_F(PioneerSession, AThreadThatSleptSendsAStopBeforeAPulse) {
  connect();
  drive(move(0.3), milliseconds(1000));
  robot.advance(milliseconds(3000));
  ASSERT_EQ(robot.velocity_mmps, 0);  // the firmware's watchdog
  robot.forget();
  run(milliseconds(1000));
  ASSERT_FALSE(robot.received.empty());
  EXPECT_EQ(robot.received[0].command, kVel);
  EXPECT_EQ(robot.received[0].argument, 0);
  EXPECT_EQ(robot.largest_motion_mmps, 0);
  EXPECT_EQ(connection->health(), Health::kReady);  // its packets were waiting: nobody was silent
}

TEST_F(PioneerSession, EStopGoesFirstAndThenTheSetpointsAreZero) {
  connect();
  drive(move(0.3, 0.5), milliseconds(500));
  robot.forget();
  BaseCommand stop = move(0.3);
  stop.estop = true;
  drive(stop, milliseconds(500));
  ASSERT_FALSE(robot.received.empty());
  EXPECT_EQ(robot.received[0].command, kEStop);
  EXPECT_EQ(robot.velocity_mmps, 0);
  EXPECT_EQ(robot.last(kVel)->argument, 0);
  EXPECT_EQ(robot.last(kRvel)->argument, 0);
}

TEST_F(PioneerSession, AWatchdogThatIsOffMissingOrSlowForbidsDriving) {
  for (const int watchdog_ms : {0, -1, 3000}) {
    robot.answers_config = watchdog_ms >= 0;
    robot.config.watchdog_ms = watchdog_ms >= 0 ? static_cast<unsigned>(watchdog_ms) : 2000U;
    start();
    ASSERT_TRUE(run_until(Health::kUnsafe)) << watchdog_ms;
    EXPECT_THAT(connection->message(), HasSubstr("driving is refused"));
    robot.forget();
    states = 0;
    const auto status = connection->command(move(0.3));
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, types::Errc::kUnsupported);
    EXPECT_TRUE(connection->command(BaseCommand{}));
    drive(move(0.3), milliseconds(1000));
    EXPECT_EQ(robot.count(kEnable), 0);
    EXPECT_EQ(robot.largest_motion_mmps, 0);
    for (const Received& r : robot.received) EXPECT_FALSE(r.command == kVel && r.argument != 0);
    EXPECT_GE(states, 9);  // what it sees is still worth having
    connection.reset();
  }
}

TEST_F(PioneerSession, AWatchdogOfTwoSecondsIsAllowed) {
  robot.config.watchdog_ms = 2000;
  connect();
  EXPECT_TRUE(connection->command(move(0.1)));
}

TEST_F(PioneerSession, TheStopButtonNeedsANewRequestForTheMotors) {
  connect();
  drive(move(0.2), milliseconds(500));
  robot.flags = 1U << 5U;
  robot.motors = false;
  robot.velocity_mmps = 0;
  drive(move(0.2), milliseconds(500));
  EXPECT_TRUE(state.stop_button);
  robot.flags = 0;
  robot.forget();
  drive(move(0.2), milliseconds(2000));
  EXPECT_EQ(robot.count(kEnable), 0);
  EXPECT_EQ(robot.last(kVel)->argument, 0);
  drive(BaseCommand{}, milliseconds(100));
  drive(move(0.2), milliseconds(1000));
  EXPECT_EQ(robot.velocity_mmps, 200);
}

TEST_F(PioneerSession, ReportsStallsAndBumpers) {
  connect();
  robot.stall_bump = 0x0001U | 0x0400U;
  run(milliseconds(200));
  EXPECT_TRUE(state.stall_left);
  EXPECT_FALSE(state.stall_right);
  EXPECT_EQ(state.bumpers_front, 2);
}

TEST_F(PioneerSession, GarbageBetweenPacketsIsCountedAndSurvived) {
  connect();
  for (int i = 0; i < 20; ++i) {
    robot.send_raw(from_hex("fa fb 06 33 01 02 03 04 05 fa fa fb 01 ff"));
    run(milliseconds(100));
  }
  EXPECT_EQ(connection->health(), Health::kReady);
  EXPECT_GT(connection->counters().bad_packets, 0U);
  EXPECT_GE(states, 20);
}

TEST_F(PioneerSession, AllocatesNothingWhileRunning) {
  connect();
  drive(move(0.2), milliseconds(1000));
  const auto before = test::allocations();
  for (int i = 0; i < 200; ++i) {
    std::ignore = connection->command(move(0.2, 0.1 * (i % 7)));
    for (int k = 0; k < 5; ++k) std::ignore = connection->step(state, milliseconds(10));
  }
  run(milliseconds(2000));  // caller silent
  EXPECT_EQ(test::allocations() - before, 0U);
}

TEST_F(PioneerSession, AnAnswerThatTheHostReadsLateIsNotLate) {
  robot.answers_encoder = true;
  robot.encoder_delay = milliseconds(60);
  connect();
  for (int stall = 0; stall < 10; ++stall) {
    drive(move(0.3), milliseconds(700));
    EXPECT_LT(state.round_trip, milliseconds(120));
    EXPECT_GT(state.round_trip, milliseconds(0));
    robot.advance(milliseconds(450));  // the host does not run, whether a request is open or not
  }
  robot.encoder_delay = milliseconds(600);
  drive(move(0.3), milliseconds(2500));
  EXPECT_GT(state.round_trip, milliseconds(500)) << "the base's own";
}

TEST_F(PioneerSession, ANewConnectionMeasuresTheRoundTripAnew) {
  robot.answers_encoder = true;
  robot.encoder_delay = milliseconds(600);
  connect();
  drive(move(0.3), milliseconds(2500));
  ASSERT_GT(state.round_trip, milliseconds(500));
  robot.encoder_delay = milliseconds(60);
  robot.cut = true;
  run(milliseconds(100));
  robot.cut = false;
  states = 0;
  ASSERT_TRUE(run_until(Health::kReady)) << connection->message();
  while (states == 0) step();
  EXPECT_LT(state.round_trip, milliseconds(120));
  drive(move(0.3), milliseconds(1500));
  EXPECT_LT(state.round_trip, milliseconds(120));
}

}  // namespace
}  // namespace topo::pioneer
