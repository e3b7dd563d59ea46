// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// A base that did not obey hears nothing, whatever happens to its connection, until it is released.
#include <gmock/gmock.h>

#include "tests/unit/drivers/pioneer/connection_fixture.hpp"

namespace topo::pioneer {
namespace {

using std::chrono::milliseconds;
using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;

types::BaseCommand silent() { return {.twist = {}, .enable_motors = false, .estop = false, .silence = true}; }

class PioneerSilence : public PioneerSession {
 protected:
  /// Drives, then does not obey: statuses come, commands are swallowed.
  void disobey() {
    connect();
    drive(move(0.3), milliseconds(800));
    ASSERT_TRUE(robot.motors);
    drive(silent(), milliseconds(500));
    robot.forget();
  }
  /// As the base thread while the connection is not ready.
  void wait(types::Duration duration) {
    for (const types::Stamp end = robot.now + duration; robot.now < end;) {
      if (connection->releases() == 0) connection->set_silence(true);
      step();
    }
  }
  void break_connection() {
    robot.cut = true;
    run(milliseconds(100));
    ASSERT_EQ(connection->health(), Health::kDisconnected);
  }
};

TEST_F(PioneerSilence, LastWordsAreEStopsAndThenNothing) {
  connect();
  drive(move(0.3), milliseconds(800));
  robot.forget();
  drive(silent(), milliseconds(3000));
  EXPECT_THAT(robot.commands(), Each(kEStop));
  EXPECT_EQ(robot.count(kEStop), 3);
}

TEST_F(PioneerSilence, BindsANewConnection) {
  disobey();
  break_connection();
  wait(milliseconds(20000));
  EXPECT_EQ(robot.opened_ports, 2);
  EXPECT_THAT(robot.commands(), IsEmpty());
  EXPECT_EQ(connection->health(), Health::kUnsafe);
  EXPECT_THAT(connection->message(), HasSubstr("topoctl clear-estop"));
}

TEST_F(PioneerSilence, BindsAfterStatusesFailed) {
  disobey();
  robot.sends_status = false;
  wait(milliseconds(3000));
  EXPECT_GT(robot.opened_ports, 1);
  EXPECT_THAT(robot.commands(), IsEmpty());
}

TEST_F(PioneerSilence, BindsFromTheFirstByteOn) {
  robot.open = robot.motors = true;
  start();
  wait(milliseconds(5000));
  EXPECT_EQ(robot.opened_ports, 1);
  EXPECT_THAT(robot.commands(), IsEmpty());
}

TEST_F(PioneerSilence, BindsTheEndOfTheConnection) {
  disobey();
  connection->close(milliseconds(300));
  EXPECT_THAT(robot.commands(), IsEmpty());
}

TEST_F(PioneerSilence, BindsTheEndWhileListening) {
  disobey();
  break_connection();
  wait(milliseconds(2000));
  connection->close(milliseconds(300));
  EXPECT_THAT(robot.commands(), IsEmpty());
}

TEST_F(PioneerSilence, MotorsThatAreOffEndIt) {
  disobey();
  break_connection();
  wait(milliseconds(2000));
  ASSERT_EQ(connection->releases(), 0U);
  robot.motors = false;
  wait(milliseconds(5000));
  EXPECT_EQ(connection->releases(), 1U);
  EXPECT_EQ(connection->health(), Health::kReady) << connection->message();
}

TEST_F(PioneerSilence, AResetOfTheControllerEndsIt) {
  disobey();
  break_connection();
  wait(milliseconds(2000));
  robot.open = robot.motors = false;
  robot.send({std::byte{0xFF}});
  wait(milliseconds(5000));
  EXPECT_EQ(connection->releases(), 1U);
  EXPECT_EQ(connection->health(), Health::kReady) << connection->message();
}

TEST_F(PioneerSilence, AResetWithinTheConnectionEndsIt) {
  disobey();
  robot.open = robot.motors = false;
  robot.send({std::byte{0xFF}});
  wait(milliseconds(5000));
  EXPECT_EQ(connection->releases(), 1U);
  EXPECT_EQ(connection->health(), Health::kReady) << connection->message();
}

TEST_F(PioneerSilence, TheOperatorEndsIt) {
  disobey();
  break_connection();
  wait(milliseconds(2000));
  connection->set_silence(false);
  EXPECT_TRUE(run_until(Health::kReady)) << connection->message();
  EXPECT_THAT(robot.commands(), testing::Contains(kEStop));
}

TEST_F(PioneerSilence, TheLinesSpeedIsFoundByListening) {
  robot.has_baud = true;
  robot.baud = 19200;
  robot.open = robot.motors = true;
  start();
  wait(milliseconds(3000));
  ASSERT_EQ(connection->releases(), 0U);
  robot.motors = false;
  wait(milliseconds(1000));
  EXPECT_EQ(connection->releases(), 1U);
}

}  // namespace
}  // namespace topo::pioneer
