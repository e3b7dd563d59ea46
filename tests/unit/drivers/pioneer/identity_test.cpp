// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Which robot answers: name and serial number, at every connection.
#include <gmock/gmock.h>

#include <algorithm>

#include "tests/unit/drivers/pioneer/connection_fixture.hpp"

namespace topo::pioneer {
namespace {

using std::chrono::milliseconds;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

struct PioneerIdentity : PioneerSession {
  PioneerIdentity() {
    config.expected_chassis = "p3dx";
    config.expected_name = "scripted";
    config.expected_serial_number = "SN123";
  }
  /// True when OPEN was sent since the last forget(); without its argument, the same command is SYNC1.
  [[nodiscard]] bool was_opened() const {
    return std::any_of(robot.received.begin(), robot.received.end(),
                       [](const Received& r) { return r.command == kOpen && r.has_argument; });
  }
  /// Tried again and again, it is never driven.
  void expect_refused_for_good() {
    changes.clear();
    run(milliseconds(30000));
    EXPECT_GE(robot.count(kSync0), 4);
    EXPECT_THAT(changes, Not(Contains(Health::kReady)));
    EXPECT_EQ(robot.count(kEnable), 0);
    EXPECT_EQ(robot.largest_motion_mmps, 0);
    EXPECT_FALSE(connection->command(move(0.1)));
  }
};

TEST_F(PioneerIdentity, TheExpectedRobotIsDriven) {
  connect();
  drive(move(0.2), milliseconds(1000));
  EXPECT_EQ(robot.velocity_mmps, 200);
}

TEST_F(PioneerIdentity, AnotherNameIsRefusedBeforeItsConnectionIsOpened) {
  robot.name = "dx-2";
  start();
  ASSERT_TRUE(run_until(Health::kWrongDevice));
  EXPECT_THAT(connection->message(),
              AllOf(HasSubstr("/dev/scripted: found robot \"dx-2\"; expected \"scripted\""),
                    HasSubstr("are the cables or addresses of two robots exchanged?")));
  expect_refused_for_good();
  EXPECT_FALSE(was_opened());
}

TEST_F(PioneerIdentity, AnotherNameInTheConfigPacketIsRefused) {
  robot.config.name = "dx-2";
  start();
  ASSERT_TRUE(run_until(Health::kWrongDevice));
  EXPECT_THAT(connection->message(), HasSubstr("\"dx-2\" (by its CONFIG packet); expected \"scripted\""));
  expect_refused_for_good();
}

TEST_F(PioneerIdentity, AnotherSerialNumberIsRefusedAndItsConnectionClosed) {
  for (const char* other : {"SN124", "SN12", "sn123", ""}) {
    robot.config.serial_number = other;
    robot.forget();
    start();
    ASSERT_TRUE(run_until(Health::kWrongDevice)) << other;
    EXPECT_THAT(connection->message(),
                AllOf(HasSubstr(std::string("with the serial number \"") + other + "\""),
                      HasSubstr("expected the serial number \"SN123\""), HasSubstr("two robots exchanged?")));
    EXPECT_FALSE(robot.open);
    expect_refused_for_good();
    EXPECT_TRUE(was_opened());  // to ask for CONFIG
    connection.reset();
  }
}

TEST_F(PioneerIdentity, ARobotThatDoesNotTellItsSerialNumberIsNotIdentified) {
  robot.answers_config = false;
  start();
  ASSERT_TRUE(run_until(Health::kUnidentified));
  EXPECT_THAT(connection->message(),
              HasSubstr("does not tell its serial number (no CONFIG packet); expected \"SN123\""));
  EXPECT_EQ(robot.count(kConfig), 3);
  EXPECT_FALSE(robot.open);
  expect_refused_for_good();
  EXPECT_THAT(changes, Not(Contains(Health::kUnsafe)));
  robot.answers_config = true;
  EXPECT_TRUE(run_until(Health::kReady));
}

TEST_F(PioneerIdentity, ALostConfigPacketIsAskedForAgain) {
  int lost = 0;
  robot.loses = [&](int command) { return command == kConfig && lost++ < 2; };
  connect();
  EXPECT_EQ(lost, 3);
}

TEST_F(PioneerIdentity, ARobotOfAKnownFamilyIsDrivenAsItsBoard) {
  robot.subclass = "p3dx-sh-lms1xx";
  connect();
  EXPECT_EQ(connection->info()->subclass, "p3dx-sh-lms1xx");
  EXPECT_THAT(connection->info()->assumed, HasSubstr("driven as p3dx-sh"));
  drive(move(0.2), milliseconds(1000));
  EXPECT_EQ(robot.velocity_mmps, 200);
}

TEST_F(PioneerIdentity, AnOlderBoardIsDrivenWithItsOwnFactors) {
  robot.subclass = "p3dx";
  connect();
  EXPECT_THAT(connection->info()->assumed, HasSubstr("0.485 mm a count"));
  drive(move(0.2), milliseconds(2000));
  drive(move(0.0), milliseconds(500));
  ASSERT_GT(robot.x_mm, 300.0);
  EXPECT_NEAR(state.odometry.T_odom_base.x_m(), 0.485e-3 * robot.x_mm, 2e-3);
}

TEST_F(PioneerIdentity, AnUnknownBoardNeedsTheKey) {
  robot.subclass = "p3dx-lms200";
  start();
  ASSERT_TRUE(run_until(Health::kWrongDevice));
  EXPECT_THAT(connection->message(), AllOf(HasSubstr("\"p3dx-lms200\""), HasSubstr("base.family")));
  expect_refused_for_good();
  config.family = "p3dx-sh";
  connect();
  EXPECT_THAT(connection->info()->assumed, HasSubstr("\"p3dx-lms200\" is driven as p3dx-sh"));
}

TEST_F(PioneerIdentity, TheKeyDoesNotOverruleAKnownBoardOrModel) {
  config.family = "p3dx";  // twice the counts of the SH board that answers
  start();
  ASSERT_TRUE(run_until(Health::kWrongDevice));
  EXPECT_THAT(connection->message(), HasSubstr("expected the family p3dx (base.family)"));
  expect_refused_for_good();
  config.family = "p3at-sh";
  robot.subclass = "seekur";
  start();
  ASSERT_TRUE(run_until(Health::kWrongDevice));
  EXPECT_THAT(connection->message(), HasSubstr("expected a p3dx (robot.model)"));
}

TEST_F(PioneerIdentity, WithoutAnExpectationAnyIsTaken) {
  config.expected_name.clear();
  config.expected_serial_number.clear();
  robot.name = robot.config.name = "dx-2";
  robot.config.serial_number.clear();
  connect();
}

TEST_F(PioneerIdentity, TheNameAloneDoesNotNeedTheConfigPacket) {
  config.expected_serial_number.clear();
  robot.answers_config = false;
  start();
  EXPECT_TRUE(run_until(Health::kUnsafe)) << connection->message();  // by the unknown watchdog, as ever
}

TEST_F(PioneerIdentity, EveryReconnectionChecksAgain) {
  connect();
  drive(move(0.3), milliseconds(1500));
  robot.cut = true;  // and another robot's cable is plugged in
  robot.forget();
  robot.config.serial_number = "SN999";
  robot.open = robot.motors = false;
  robot.setpoint_mmps = robot.velocity_mmps = 0;
  run(milliseconds(100));
  ASSERT_TRUE(run_until(Health::kWrongDevice)) << connection->message();
  EXPECT_THAT(connection->message(), HasSubstr("\"SN999\""));
  expect_refused_for_good();
  robot.config.serial_number = "SN123";
  ASSERT_TRUE(run_until(Health::kReady));
  robot.forget();
  // A controller's reset is a new connection too.
  robot.name = "dx-2";
  robot.send({std::byte{0xFE}, std::byte{1}, std::byte{2}});
  robot.open = robot.motors = false;
  ASSERT_TRUE(run_until(Health::kWrongDevice)) << connection->message();
  expect_refused_for_good();
}

/// What reaches the operator is cut at 240 characters (DeviceReport::message).
TEST_F(PioneerIdentity, TheLongestMessageKeepsItsCure) {
  constexpr std::size_t kKept = 240;
  const std::string long_name(20, 'n'), long_number(20, 's');  // as long as ARCOS keeps them
  config.expected_name = robot.name = robot.config.name = long_name;
  config.expected_serial_number = long_number;
  robot.config.serial_number = std::string(20, 'o');
  start();
  ASSERT_TRUE(run_until(Health::kWrongDevice));
  EXPECT_LE(connection->message().size(), kKept);
}

}  // namespace
}  // namespace topo::pioneer
