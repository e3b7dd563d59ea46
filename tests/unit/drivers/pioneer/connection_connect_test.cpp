// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// How a connection comes about, is lost, healed and closed; session_test.cpp has the driving.
#include "tests/unit/drivers/pioneer/connection_fixture.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <memory>

namespace topo::pioneer {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;
using types::Stamp;

TEST_F(PioneerSession, ConnectsInTheOrderOfTheProtocol) {
  connect();
  EXPECT_THAT(robot.commands(), ElementsAre(kEStop, kVel, kRvel, kClose, kSync0, 1, 2, kOpen, kVel, kRvel,
                                            kConfig, kVel, kRvel, kSetV, 5, 5, 10, 23, 23, 28, kEncoder));
  EXPECT_TRUE(robot.received[3].has_argument);   // CLOSE, not SYNC2
  EXPECT_FALSE(robot.received[6].has_argument);  // SYNC2
  EXPECT_EQ(robot.received[13].argument, 700);
  EXPECT_EQ(robot.received[14].argument, 300);
  EXPECT_EQ(robot.received[15].argument, -500);
  EXPECT_EQ(robot.received[19].argument, 1);
  EXPECT_THAT(changes, ElementsAre(Health::kConnecting, Health::kReady));
  ASSERT_TRUE(connection->info());
  EXPECT_EQ(connection->info()->subclass, "p3dx-sh");
  EXPECT_EQ(connection->info()->watchdog_ms, 2000);
  EXPECT_EQ(connection->info()->serial_number, "SN123");
  EXPECT_DOUBLE_EQ(connection->info()->low_battery_v, 11.0);
  EXPECT_DOUBLE_EQ(connection->info()->v_top_mps, 1.2);
  EXPECT_NEAR(connection->info()->track_m, 0.357, 1e-3);
  EXPECT_EQ(connection->info()->sonars, 16U);
  EXPECT_THAT(connection->message(), HasSubstr("/dev/scripted"));
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
  EXPECT_TRUE(run_until(Health::kRefuses));
  EXPECT_THAT(connection->message(), HasSubstr("CLOSE"));
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
    connection.reset();
  }
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
  EXPECT_EQ(connection->health(), Health::kReset);
  EXPECT_FALSE(connection->command(move(0.1)));
  robot.forget();
  ASSERT_TRUE(run_until(Health::kReady)) << connection->message();
  EXPECT_THAT(changes, ElementsAre(Health::kReset, Health::kConnecting, Health::kReady));
  EXPECT_EQ(robot.received[0].command, kEStop);
  EXPECT_EQ(connection->counters().reconnects, 1U);
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
  EXPECT_TRUE(run_until(Health::kReady)) << connection->message();
}

TEST_F(PioneerSession, ARobotThatIsNotHeardHearsNothingButTheStop) {
  connect();
  drive(move(0.6), milliseconds(1500));
  ASSERT_EQ(robot.velocity_mmps, 600);
  robot.forget();
  robot.sends_status = false;
  const Stamp silent = robot.now;
  const double x_mm = robot.x_mm;
  // The base thread drives until it sees that nothing is heard, and then asks for a standstill.
  constexpr milliseconds kSeen(350);
  const Stamp bites = silent + kSeen + milliseconds(robot.config.watchdog_ms);
  robot.loses = [this, bites](int command) {
    return robot.now < bites && (command == kEStop || command == kVel);
  };
  drive(move(0.6), kSeen);
  drive(move(0.0), bites - robot.now);
  const auto feeds = [&](const Received& r) { return r.stamp > silent + kSeen; };
  EXPECT_EQ(std::count_if(robot.received.begin(), robot.received.end(), feeds), 0)
      << "would have fed the watchdog of a robot that drives";
  drive(move(0.0), milliseconds(5000));
  EXPECT_EQ(robot.velocity_mmps, 0);
  EXPECT_LE(robot.x_mm - x_mm, 0.6 * 1e3 * types::to_seconds(bites - silent) + 1.0);
}

TEST_F(PioneerSession, TheFirstThatArrivesOnALossyLineIsTheStop) {
  // A connection whose host died, the robot at rest since; what is sent first, SYNC0 included, is lost.
  robot.open = robot.motors = true;
  robot.setpoint_mmps = 600;
  robot.sends_status = false;
  const auto sent = std::make_shared<int>(0);
  robot.loses = [sent](int) { return ++*sent <= 5; };
  start();
  run(milliseconds(1000));
  ASSERT_GT(*sent, 5);
  EXPECT_EQ(robot.received.front().command, kEStop);
  EXPECT_EQ(robot.largest_motion_mmps, 0);
}

TEST_F(PioneerSession, ARobotThatIsHeardToStandIsTakenUpAtOnce) {
  connect();
  drive(move(0.6), milliseconds(1500));
  ASSERT_EQ(robot.velocity_mmps, 600);
  const Stamp lost = robot.now;
  robot.forget();
  robot.cut = true;  // until the port is opened again
  run(milliseconds(100));
  ASSERT_TRUE(run_until(Health::kReady)) << connection->message();
  EXPECT_EQ(robot.received.front().command, kEStop);
  EXPECT_LT(robot.now - lost, milliseconds(1800)) << "waited for the watchdog of a robot that was heard";
}

TEST_F(PioneerSession, BacksOffWhileThereIsNoPort) {
  robot.port_exists = false;
  start();
  run(milliseconds(100));
  EXPECT_EQ(connection->health(), Health::kDisconnected);
  EXPECT_THAT(connection->message(), HasSubstr("no such device"));
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
  EXPECT_THAT(connection->message(), HasSubstr("nothing answers"));
  EXPECT_THAT(changes, ElementsAre(Health::kConnecting, Health::kSilent));
}

TEST_F(PioneerSession, AnUnpluggedLineIsNamedAndHealed) {
  connect();
  robot.cut = true;
  robot.port_exists = false;
  ASSERT_TRUE(run_until(Health::kDisconnected));
  EXPECT_THAT(connection->message(), HasSubstr("/dev/scripted"));
  EXPECT_FALSE(connection->command(move(0.1)));
  robot.port_exists = true;
  EXPECT_TRUE(run_until(Health::kReady));
}

TEST_F(PioneerSession, AnotherDeviceIsNamedByWhatItSays) {
  robot.chatter = "00P\n\n";
  start();
  ASSERT_TRUE(run_until(Health::kWrongDevice));
  EXPECT_THAT(connection->message(), HasSubstr("00P"));
  EXPECT_THAT(connection->message(), HasSubstr("expected a Pioneer"));
}

TEST_F(PioneerSession, ALoopBackPlugIsNoRobot) {
  robot.echoes = true;
  start();
  ASSERT_TRUE(run_until(Health::kWrongDevice));
  EXPECT_THAT(connection->message(), HasSubstr("echoes"));
}

TEST_F(PioneerSession, AnotherRobotIsNamed) {
  robot.subclass = "peoplebot-sh";
  start();
  ASSERT_TRUE(run_until(Health::kWrongDevice));
  EXPECT_THAT(connection->message(), HasSubstr("peoplebot-sh"));
  EXPECT_THAT(connection->message(), HasSubstr("p3at-sh"));
  connection.reset();
  robot.subclass = "p3at-sh";
  config.expected_chassis = "p3dx";
  start();
  ASSERT_TRUE(run_until(Health::kWrongDevice));
  EXPECT_THAT(connection->message(), HasSubstr("expected a p3dx (robot.model)"));
}

TEST_F(PioneerSession, TheP3AtHasItsOwnNumbers) {
  robot.subclass = "p3at-sh";
  config.expected_chassis = "p3at";
  connect();
  EXPECT_NEAR(connection->info()->track_m, 0.588, 1e-3);
  EXPECT_DOUBLE_EQ(connection->info()->v_top_mps, 0.7);
  EXPECT_DOUBLE_EQ(connection->info()->T_base_sonar[3].x_m, 0.245);
}

TEST_F(PioneerSession, CloseStopsAndLeavesNothingOpen) {
  connect();
  drive(move(0.3), milliseconds(500));
  robot.forget();
  connection->close(milliseconds(1000));
  EXPECT_THAT(robot.commands(), ElementsAre(kEStop, kVel, kRvel, kEnable, kClose));
  EXPECT_EQ(robot.received[3].argument, 0);
  EXPECT_FALSE(robot.open);
  EXPECT_EQ(connection->health(), Health::kDisconnected);
  robot.forget();
  run(milliseconds(2000));
  EXPECT_TRUE(robot.received.empty());
}

TEST_F(PioneerSession, CloseIsBoundedWhenTheLineIsDead) {
  connect();
  drive(move(0.3), milliseconds(500));
  robot.powered = false;
  const Stamp before = robot.now;
  connection->close(milliseconds(300));
  EXPECT_LE(robot.now - before, milliseconds(320));
}

}  // namespace
}  // namespace topo::pioneer
