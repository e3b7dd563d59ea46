// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Simulators that take the opening for wrong SYNCs: AMRISim as shipped echoes each number, goes on from there
// and closes the connection.
#include <gmock/gmock.h>

#include <algorithm>

#include "tests/unit/drivers/pioneer/connection_fixture.hpp"

namespace topo::pioneer {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using Simulator = ScriptedRobot::Simulator;

struct PioneerOpening : PioneerSession {
  PioneerOpening() { robot.port = "tcp:simulator:8101"; }
};

TEST_F(PioneerOpening, ASimulatorThatEchoesItIsTakenUpWithSyncAlone) {
  robot.simulator = Simulator::kEchoes;
  start();
  ASSERT_TRUE(run_until(Health::kReady, milliseconds(4000))) << connection->message();
  EXPECT_EQ(robot.received[0].command, kEStop) << "the safety of a real robot comes first";
  EXPECT_EQ(robot.opened_ports, 2);
  drive(move(0.2), milliseconds(1000));
  EXPECT_EQ(robot.velocity_mmps, 200);
}

TEST_F(PioneerOpening, SoIsOneThatClosesTheConnection) {
  robot.simulator = Simulator::kCloses;
  start();
  ASSERT_TRUE(run_until(Health::kReady, milliseconds(4000))) << connection->message();
  EXPECT_EQ(robot.opened_ports, 2);
}

TEST_F(PioneerOpening, TheRefusalIsTold) {
  robot.simulator = Simulator::kEchoes;
  start();
  run(milliseconds(300));
  EXPECT_THAT(connection->message(), HasSubstr("takes the opening E_STOP for SYNC"));
}

TEST_F(PioneerOpening, BeforeSyncAloneItListensForAnOpenConnection) {
  robot.simulator = Simulator::kCloses;
  start();
  for (const types::Stamp end = robot.now + milliseconds(5000); robot.now < end && robot.opened_ports < 2;)
    step(milliseconds(1));
  ASSERT_EQ(robot.opened_ports, 2);
  const types::Stamp opened = robot.now;
  robot.forget();
  run(milliseconds(300));
  EXPECT_TRUE(robot.received.empty());
  ASSERT_TRUE(run_until(Health::kReady));
  EXPECT_EQ(robot.received[0].command, kSync0);
  EXPECT_GE(robot.received[0].stamp - opened, milliseconds(300)) << "three status cycles";
}

TEST_F(PioneerOpening, AnOpenConnectionGetsTheFullOpeningFirst) {
  robot.simulator = Simulator::kCloses;
  start();
  run(milliseconds(100));
  robot.forget();
  // Behind the same address there is a robot now that resumes its last setpoint on any packet.
  robot.simulator = Simulator::kNone;
  robot.open = robot.motors = true;
  robot.setpoint_mmps = 600;
  ASSERT_TRUE(run_until(Health::kReady)) << connection->message();
  EXPECT_EQ(robot.received[0].command, kEStop);
  EXPECT_EQ(robot.largest_motion_mmps, 0);
}

TEST_F(PioneerOpening, ARobotThatMayStillDriveIsNeverSentSyncAlone) {
  robot.simulator = Simulator::kEchoes;
  start();
  ASSERT_TRUE(run_until(Health::kReady));
  drive(move(0.6), milliseconds(1500));
  ASSERT_EQ(robot.velocity_mmps, 600);
  robot.cut = true;
  const types::Stamp lost = robot.now;
  robot.forget();
  run(milliseconds(100));
  ASSERT_TRUE(run_until(Health::kReady)) << connection->message();
  const auto synced = std::find_if(robot.received.begin(), robot.received.end(),
                                   [](const Received& r) { return r.command == kSync0; });
  ASSERT_NE(synced, robot.received.end());
  EXPECT_GE(synced->stamp - lost, milliseconds(robot.config.watchdog_ms));
  EXPECT_EQ(robot.received[0].command, kEStop);
}

TEST_F(PioneerOpening, OnASerialPortOrACanBusTheOpeningIsAlwaysFull) {
  for (const char* port : {"/dev/scripted", "can:can0:0"}) {
    robot.port = port;
    robot.simulator = Simulator::kCloses;
    robot.forget();
    start();
    run(milliseconds(20000));
    EXPECT_EQ(robot.count(kSync0), 0) << port;
    EXPECT_GE(robot.count(kEStop), 3) << port;
    connection.reset();
  }
}

TEST_F(PioneerOpening, ALineThatEchoesEverythingIsStillNamed) {
  robot.echoes = true;
  start();
  ASSERT_TRUE(run_until(Health::kWrongDevice));
  EXPECT_THAT(connection->message(), HasSubstr("a line that echoes?"));
}

}  // namespace
}  // namespace topo::pioneer
