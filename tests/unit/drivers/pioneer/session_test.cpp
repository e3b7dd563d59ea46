// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <tuple>

#include "tests/unit/drivers/pioneer/allocation_count.hpp"
#include "tests/unit/drivers/pioneer/scripted_robot.hpp"

namespace topo::pioneer {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;
using types::BaseCommand;
using types::BaseState;
using types::Duration;
using types::Stamp;

constexpr int kSync0 = 0, kOpen = 1, kClose = 2, kEnable = 4, kSetV = 6, kVel = 11, kConfig = 18, kRvel = 21,
              kEStop = 55, kPulse = 0;

class PioneerSession : public testing::Test {
 protected:
  ScriptedRobot robot;
  SessionConfig config;
  std::unique_ptr<Session> session;
  BaseState state;
  std::vector<Health> changes;
  int states = 0;

  void start() { session = std::make_unique<Session>(config, std::make_unique<ScriptedConnector>(robot)); }

  void step(Duration timeout = milliseconds(20)) {
    const Stamp before = robot.now;
    const auto outcome = session->step(state, timeout);
    EXPECT_LE(robot.now - before, timeout + milliseconds(1));
    if (outcome == StepOutcome::kChanged) changes.push_back(session->health());
    if (outcome == StepOutcome::kState) ++states;
  }
  void run(Duration duration) {
    for (const Stamp end = robot.now + duration; robot.now < end;) step();
  }
  bool run_until(Health wanted, Duration limit = milliseconds(20000)) {
    for (const Stamp end = robot.now + limit; robot.now < end && session->health() != wanted;) step();
    return session->health() == wanted;
  }
  /// As the base thread: a command every 50 ms.
  void drive(const BaseCommand& command, Duration duration) {
    for (const Stamp end = robot.now + duration; robot.now < end;) {
      std::ignore = session->command(command);
      for (const Stamp period = robot.now + milliseconds(50); robot.now < period;) step(period - robot.now);
    }
  }
  void connect() {
    start();
    ASSERT_TRUE(run_until(Health::kReady)) << session->message();
    run(milliseconds(200));
  }
  static BaseCommand move(double v_mps, double omega_radps = 0.0) {
    return {.twist = {v_mps, omega_radps}, .enable_motors = true, .estop = false};
  }
};

TEST_F(PioneerSession, ConnectsInTheOrderOfTheProtocol) {
  connect();
  EXPECT_THAT(robot.commands(), ElementsAre(kEStop, kVel, kRvel, kClose, kSync0, 1, 2, kOpen, kVel, kRvel,
                                            kConfig, kVel, kRvel, kSetV, 5, 5, 10, 23, 23, 28));
  EXPECT_TRUE(robot.received[3].has_argument);   // CLOSE, not SYNC2
  EXPECT_FALSE(robot.received[6].has_argument);  // SYNC2
  EXPECT_EQ(robot.received[13].argument, 700);
  EXPECT_EQ(robot.received[14].argument, 300);
  EXPECT_EQ(robot.received[15].argument, -500);
  EXPECT_EQ(robot.received[19].argument, 1);
  EXPECT_THAT(changes, ElementsAre(Health::kConnecting, Health::kReady));
  ASSERT_TRUE(session->info());
  EXPECT_EQ(session->info()->subclass, "p3dx-sh");
  EXPECT_EQ(session->info()->watchdog_ms, 2000);
  EXPECT_EQ(session->info()->serial_number, "SN123");
  EXPECT_DOUBLE_EQ(session->info()->low_battery_v, 11.0);
  EXPECT_DOUBLE_EQ(session->info()->v_top_mps, 1.2);
  EXPECT_NEAR(session->info()->track_m, 0.357, 1e-3);
  EXPECT_EQ(session->info()->sonars, 16U);
  EXPECT_THAT(session->message(), HasSubstr("/dev/scripted"));
}

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
  EXPECT_EQ(state.sequence, session->counters().status_packets);
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
  EXPECT_GE(robot.count(kPulse), 4);
  EXPECT_EQ(session->health(), Health::kReady);
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
  EXPECT_EQ(session->health(), Health::kReady);  // its packets were waiting: nobody was silent
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

TEST_F(PioneerSession, AStaleSessionIsClosedFirst) {
  robot.open = true;
  connect();
  const auto sent = robot.commands();
  ASSERT_GE(sent.size(), 5U);
  EXPECT_THAT(std::vector<int>(sent.begin(), sent.begin() + 5),
              ElementsAre(kEStop, kVel, kRvel, kClose, kSync0));
}

TEST_F(PioneerSession, AStaleSessionThatIgnoresCloseIsNamed) {
  robot.open = true;
  robot.deaf_to_close = true;
  start();
  EXPECT_TRUE(run_until(Health::kSilent));
  EXPECT_THAT(session->message(), HasSubstr("CLOSE"));
  EXPECT_EQ(robot.count(kSync0), 0);
}

TEST_F(PioneerSession, ARobotThatResumesItsLastSetpointDoesNotMove) {
  // The host died at 0.6 m/s; the watchdog stopped the robot, which remembers.
  robot.open = robot.motors = true;
  robot.setpoint_mmps = 600;
  robot.setpoint_degps = 40;
  connect();
  EXPECT_EQ(robot.received[0].command, kEStop);
  EXPECT_EQ(robot.largest_motion_mmps, 0);
  EXPECT_EQ(robot.setpoint_mmps, 0);
  EXPECT_EQ(robot.setpoint_degps, 0);
}

TEST_F(PioneerSession, TheFirstBytesAreTheSameAtEveryBaudRate) {
  robot.has_baud = true;
  robot.baud = 57600;  // the last one tried
  robot.open = robot.motors = true;
  robot.setpoint_mmps = 600;
  connect();
  EXPECT_EQ(robot.received[0].command, kEStop);
  EXPECT_EQ(robot.received[0].baud, 57600);
  EXPECT_EQ(robot.largest_motion_mmps, 0);
}

TEST_F(PioneerSession, FindsEveryBaudRateAndTriesItFirstTheNextTime) {
  for (const int baud : {9600, 19200, 38400, 57600, 115200}) {
    robot.has_baud = true;
    robot.baud = baud;
    connect();
    const Stamp lost = robot.now;
    robot.cut = true;
    run(milliseconds(100));
    ASSERT_TRUE(run_until(Health::kReady));
    EXPECT_LT(robot.now - lost, milliseconds(1800)) << baud;
    session.reset();
  }
}

TEST_F(PioneerSession, AWatchdogThatIsOffMissingOrSlowForbidsDriving) {
  for (const int watchdog_ms : {0, -1, 3000}) {
    robot.answers_config = watchdog_ms >= 0;
    robot.config.watchdog_ms = watchdog_ms >= 0 ? static_cast<unsigned>(watchdog_ms) : 2000U;
    start();
    ASSERT_TRUE(run_until(Health::kUnsafe)) << watchdog_ms;
    EXPECT_THAT(session->message(), HasSubstr("driving is refused"));
    robot.forget();
    states = 0;
    const auto status = session->command(move(0.3));
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, types::Errc::kUnsupported);
    EXPECT_TRUE(session->command(BaseCommand{}));
    drive(move(0.3), milliseconds(1000));
    EXPECT_EQ(robot.count(kEnable), 0);
    EXPECT_EQ(robot.largest_motion_mmps, 0);
    for (const Received& r : robot.received) EXPECT_FALSE(r.command == kVel && r.argument != 0);
    EXPECT_GE(states, 9);  // what it sees is still worth having
    session.reset();
  }
}

TEST_F(PioneerSession, AWatchdogOfTwoSecondsIsAllowed) {
  robot.config.watchdog_ms = 2000;
  connect();
  EXPECT_TRUE(session->command(move(0.1)));
}

TEST_F(PioneerSession, AResetLeadsToANewConnection) {
  connect();
  drive(move(0.2), milliseconds(1000));
  const double x_m = state.odometry.T_odom_base.x_m();
  robot.send({std::byte{0xFE}, std::byte{1}, std::byte{2}});
  robot.open = robot.motors = false;
  robot.x_mm = 0.0;
  changes.clear();
  run(milliseconds(100));
  EXPECT_EQ(session->health(), Health::kReset);
  EXPECT_FALSE(session->command(move(0.1)));
  robot.forget();
  ASSERT_TRUE(run_until(Health::kReady)) << session->message();
  EXPECT_THAT(changes, ElementsAre(Health::kReset, Health::kConnecting, Health::kReady));
  EXPECT_EQ(robot.received[0].command, kEStop);
  EXPECT_EQ(session->counters().reconnects, 1U);
  run(milliseconds(300));
  EXPECT_NEAR(state.odometry.T_odom_base.x_m(), x_m, 0.05);  // the pose goes on
}

TEST_F(PioneerSession, SilenceIsNoticedAfterFiveCyclesAndHealed) {
  connect();
  robot.sends_status = false;
  const Stamp silent = robot.now;
  ASSERT_TRUE(run_until(Health::kSilent));
  EXPECT_LT(robot.now - silent, milliseconds(650));
  EXPECT_EQ(robot.last(kEStop), &robot.received.back());
  robot.sends_status = true;
  EXPECT_TRUE(run_until(Health::kReady)) << session->message();
}

TEST_F(PioneerSession, BacksOffWhileThereIsNoPort) {
  robot.port_exists = false;
  start();
  run(milliseconds(100));
  EXPECT_EQ(session->health(), Health::kDisconnected);
  EXPECT_THAT(session->message(), HasSubstr("no such device"));
  changes.clear();
  run(milliseconds(30000));
  EXPECT_THAT(changes, ElementsAre());  // told once
  robot.port_exists = true;
  const Stamp plugged = robot.now;
  EXPECT_TRUE(run_until(Health::kReady));
  EXPECT_LT(robot.now - plugged, milliseconds(6500));
}

TEST_F(PioneerSession, BackOffGrowsFromHalfASecondToFive) {
  robot.powered = false;
  start();
  std::vector<double> opened;
  int before = 0;
  for (const Stamp end = robot.now + milliseconds(40000); robot.now < end; step()) {
    if (robot.opened_ports == before) continue;
    before = robot.opened_ports;
    opened.push_back(types::to_seconds(robot.now));
  }
  ASSERT_GE(opened.size(), 6U);
  const double attempt_s = 1.15;  // first bytes, quiet time, three SYNC0
  EXPECT_NEAR(opened[1] - opened[0], attempt_s + 0.5, 0.15);
  EXPECT_NEAR(opened[2] - opened[1], attempt_s + 1.0, 0.15);
  EXPECT_NEAR(opened[3] - opened[2], attempt_s + 2.0, 0.15);
  EXPECT_NEAR(opened[5] - opened[4], attempt_s + 5.0, 0.15);
  EXPECT_THAT(session->message(), HasSubstr("nothing answers"));
  EXPECT_THAT(changes, ElementsAre(Health::kConnecting, Health::kSilent));
}

TEST_F(PioneerSession, AnUnpluggedLineIsNamedAndHealed) {
  connect();
  robot.cut = true;
  robot.port_exists = false;
  ASSERT_TRUE(run_until(Health::kDisconnected));
  EXPECT_THAT(session->message(), HasSubstr("/dev/scripted"));
  EXPECT_FALSE(session->command(move(0.1)));
  robot.port_exists = true;
  EXPECT_TRUE(run_until(Health::kReady));
}

TEST_F(PioneerSession, AnotherDeviceIsNamedByWhatItSays) {
  robot.chatter = "00P\n\n";
  start();
  ASSERT_TRUE(run_until(Health::kWrongDevice));
  EXPECT_THAT(session->message(), HasSubstr("00P"));
  EXPECT_THAT(session->message(), HasSubstr("expected a Pioneer"));
}

TEST_F(PioneerSession, ALoopBackPlugIsNoRobot) {
  robot.echoes = true;
  start();
  ASSERT_TRUE(run_until(Health::kWrongDevice));
  EXPECT_THAT(session->message(), HasSubstr("echoes"));
}

TEST_F(PioneerSession, AnotherRobotIsNamed) {
  robot.subclass = "peoplebot-sh";
  start();
  ASSERT_TRUE(run_until(Health::kWrongDevice));
  EXPECT_THAT(session->message(), HasSubstr("peoplebot-sh"));
  EXPECT_THAT(session->message(), HasSubstr("p3at-sh"));
  session.reset();
  robot.subclass = "p3at-sh";
  config.expected_subclass = "p3dx-sh";
  start();
  ASSERT_TRUE(run_until(Health::kWrongDevice));
  EXPECT_THAT(session->message(), HasSubstr("expected subclass \"p3dx-sh\""));
}

TEST_F(PioneerSession, TheP3AtHasItsOwnNumbers) {
  robot.subclass = "p3at-sh";
  config.expected_subclass = "p3at-sh";
  connect();
  EXPECT_NEAR(session->info()->track_m, 0.588, 1e-3);
  EXPECT_DOUBLE_EQ(session->info()->v_top_mps, 0.7);
  EXPECT_DOUBLE_EQ(session->info()->T_base_sonar[3].x_m, 0.245);
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
  EXPECT_EQ(session->health(), Health::kReady);
  EXPECT_GT(session->counters().bad_packets, 0U);
  EXPECT_GE(states, 20);
}

TEST_F(PioneerSession, CloseStopsAndLeavesNothingOpen) {
  connect();
  drive(move(0.3), milliseconds(500));
  robot.forget();
  session->close(milliseconds(1000));
  EXPECT_THAT(robot.commands(), ElementsAre(kEStop, kVel, kRvel, kEnable, kClose));
  EXPECT_EQ(robot.received[3].argument, 0);
  EXPECT_FALSE(robot.open);
  EXPECT_EQ(session->health(), Health::kDisconnected);
  robot.forget();
  run(milliseconds(2000));
  EXPECT_TRUE(robot.received.empty());
}

TEST_F(PioneerSession, CloseIsBoundedWhenTheLineIsDead) {
  connect();
  drive(move(0.3), milliseconds(500));
  robot.powered = false;
  const Stamp before = robot.now;
  session->close(milliseconds(300));
  EXPECT_LE(robot.now - before, milliseconds(320));
}

TEST_F(PioneerSession, AllocatesNothingWhileRunning) {
  connect();
  drive(move(0.2), milliseconds(1000));
  const auto before = allocations();
  for (int i = 0; i < 200; ++i) {
    std::ignore = session->command(move(0.2, 0.1 * (i % 7)));
    for (int k = 0; k < 5; ++k) std::ignore = session->step(state, milliseconds(10));
  }
  run(milliseconds(2000));  // caller silent
  EXPECT_EQ(allocations() - before, 0U);
}

}  // namespace
}  // namespace topo::pioneer
