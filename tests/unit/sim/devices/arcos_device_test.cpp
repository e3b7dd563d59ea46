// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// What the simulated base does and senses; arcos_wire_test.cpp has how it speaks.
#include "tests/unit/sim/devices/arcos_robot.hpp"

namespace topo::sim {
namespace {

using namespace std::chrono_literals;

TEST(ArcosDevice, NeedsEnableToMove) {
  Robot robot;
  robot.connect();
  robot.ask(command(11, 200));
  robot.run(500ms);
  EXPECT_EQ(robot.speed_mm_s(), 0.0);
  robot.ask(command(4, 1) + command(11, 200));
  robot.run(1s);
  EXPECT_NEAR(robot.speed_mm_s(), 200.0, 0.1);
  EXPECT_EQ(u8(last_sip(robot.run(200ms)), 0), 0x33);
}

TEST(ArcosDevice, RampsWithTheWorkingAccelerations) {
  Robot robot;
  robot.connect();
  robot.ask(command(4, 1) + command(5, 100) + command(5, -400) + command(11, 400));
  robot.run(1s);
  EXPECT_NEAR(robot.speed_mm_s(), 100.0, 1.0);
  robot.run_fed(4s);
  EXPECT_NEAR(robot.speed_mm_s(), 400.0, 1.0);
  robot.ask(command(29));
  robot.run_fed(500ms);
  EXPECT_NEAR(robot.speed_mm_s(), 200.0, 1.0);
  robot.ask(command(11, 400));
  robot.run_fed(3s);
  robot.ask(command(55));
  robot.run_fed(100ms);
  EXPECT_NEAR(robot.speed_mm_s(), 200.0, 2.0) << "E_STOP brakes with the greatest deceleration";
}

TEST(ArcosDevice, ClampsToSetvThenTop) {
  Robot robot;
  robot.connect();
  robot.ask(command(4, 1) + command(6, 150) + command(11, 1000) + command(5, 2000));
  robot.run(1s);
  EXPECT_NEAR(robot.speed_mm_s(), 150.0, 0.1);
  robot.ask(command(6, 30000));
  robot.run(1s);
  EXPECT_NEAR(robot.speed_mm_s(), 1000.0, 0.1);
}

TEST(ArcosDevice, WatchdogStopsAndAnyPacketResumes) {
  Robot robot;
  robot.connect();
  robot.ask(command(4, 1) + command(11, 300));
  robot.run(1900ms);
  EXPECT_NEAR(robot.speed_mm_s(), 300.0, 0.1);
  robot.run(1500ms);
  EXPECT_EQ(robot.speed_mm_s(), 0.0);
  EXPECT_FALSE(last_sip(robot.run(200ms)).empty()) << "the session stays";
  robot.ask(command(0));
  robot.run(1s);
  EXPECT_NEAR(robot.speed_mm_s(), 300.0, 0.1) << "the danger of PROTOCOLS section 2";
}

TEST(ArcosDevice, TheDriversFirstBytesEndAResumedMotion) {
  Robot robot;
  robot.connect();
  robot.ask(command(4, 1) + command(11, 300));
  robot.run(5s);
  robot.ask(command(55) + command(11, 0) + command(21, 0) + command(2, 1) + command(0));
  robot.run(1s);
  EXPECT_EQ(robot.inputs.left_mps, 0.0);
  EXPECT_FALSE(robot.device.motors_on());
}

TEST(ArcosDevice, Vel2DrivesTheWheelsInBothForms) {
  for (const std::string& vel2 : {command(32, 0x0AFB), command(32, -(0x10000 - 0xFB0A))}) {
    Robot robot;
    robot.connect();
    robot.ask(command(4, 1) + command(5, 2000) + command(23, 300) + vel2);
    robot.run(1500ms);
    const bool first =
        vel2 == command(32, 0x0AFB);  // left +200, right -100; else left -100 (0xFB), right +200
    EXPECT_NEAR(robot.inputs.left_mps, first ? 0.2 : -0.1, 0.002);
    EXPECT_NEAR(robot.inputs.right_mps, first ? -0.1 : 0.2, 0.002);
  }
}

/// What the wheels did, which the firmware's counts do not enter.
struct Truth {
  explicit Truth(const Robot& robot)
      : way_mm((robot.inputs.left_m + robot.inputs.right_m) * 500.0),
        turn_deg((robot.inputs.right_m - robot.inputs.left_m) * 1e3 / robot.device.parameters().track_mm *
                 180.0 / 3.14159265358979) {}
  double way_mm, turn_deg;
};

TEST(ArcosDevice, MoveDrivesItsWayAtSetvAndStands) {
  for (const int way_mm : {1500, -1500, 40, -5000}) {
    Robot robot;
    robot.connect();
    robot.ask(command(4, 1) + command(6, 400) + command(8, way_mm));
    robot.run_fed(2s);
    if (std::abs(way_mm) > 1000) {
      EXPECT_NEAR(robot.speed_mm_s(), std::copysign(400.0, way_mm), 1.0);
    }
    robot.run_fed(16s);
    EXPECT_EQ(robot.speed_mm_s(), 0.0) << way_mm;
    EXPECT_NEAR(Truth(robot).way_mm, way_mm, 2.0);
  }
}

/// ARIA sends no RVEL 0 between VEL2 and MOVE (PROTOCOLS section 3: exclusive modes).
TEST(ArcosDevice, WhatVel2SetEndsWithEveryOtherMotion) {
  const std::string wheels = command(32, 0x0A05);  // forwards, turning
  for (const int other : {8, 11, 12, 13, 21, 22}) {
    Robot robot;
    robot.connect();
    robot.ask(command(4, 1) + command(5, 2000) + command(23, 300) + wheels);
    robot.run_fed(1500ms);
    ASSERT_NEAR(robot.speed_mm_s(), 150.0, 5.0);
    const bool drives = other == 8 || other == 11;
    robot.ask(command(other, drives ? 300 : 20));
    robot.run_fed(1s);  // what was set is braked away
    const Truth before(robot);
    robot.run_fed(1s);
    const Truth after(robot);
    if (drives) {
      EXPECT_NEAR(after.turn_deg, before.turn_deg, 0.5) << other;
    } else {
      EXPECT_NEAR(after.way_mm, before.way_mm, 1.0) << other;
    }
  }
}

TEST(ArcosDevice, MoveIsBoundedAndEndsWithVelOrStop) {
  Robot robot;
  robot.connect();
  robot.ask(command(4, 1) + command(8, 32000));
  robot.run_fed(15s);
  EXPECT_NEAR(Truth(robot).way_mm, 5000.0, 2.0) << "PROTOCOLS section 3: within 5 m";
  robot.ask(command(8, 3000));
  robot.run_fed(1s);
  robot.ask(command(11, 100));
  robot.run_fed(3s);
  EXPECT_NEAR(robot.speed_mm_s(), 100.0, 1.0);
  robot.ask(command(8, 3000));
  robot.run_fed(1s);
  robot.ask(command(29));
  robot.run_fed(3s);
  EXPECT_EQ(robot.speed_mm_s(), 0.0);
}

TEST(ArcosDevice, HeadTurnsTheShorterWay) {
  Robot robot;
  robot.connect();
  robot.ask(command(4, 1) + command(12, 170));
  robot.run_fed(6s);
  EXPECT_NEAR(Truth(robot).turn_deg, 170.0, 0.3);
  robot.ask(command(12, 200));
  robot.run_fed(4s);
  EXPECT_NEAR(Truth(robot).turn_deg, 200.0, 0.3);
  robot.ask(command(12, 0));
  robot.run_fed(6s);
  EXPECT_NEAR(Truth(robot).turn_deg, 360.0, 0.3) << "160 degrees on, not 200 back";
}

TEST(ArcosDevice, DheadIsFromHereAndDcheadFromTheLastSetpoint) {
  Robot robot;
  robot.connect();
  robot.ask(command(4, 1) + command(13, 90));
  robot.run_fed(400ms);
  ASSERT_LT(Truth(robot).turn_deg, 30.0) << "under way";
  robot.ask(command(22, -30));
  robot.run_fed(5s);
  EXPECT_NEAR(Truth(robot).turn_deg, 60.0, 0.3) << "90 - 30";
  robot.ask(command(13, -90));
  robot.run_fed(400ms);
  const double from_deg = Truth(robot).turn_deg;
  robot.ask(command(13, 45));
  robot.run_fed(5s);
  EXPECT_NEAR(Truth(robot).turn_deg, from_deg + 45.0, 0.5);
}

TEST(ArcosDevice, MoveAndHeadGoTogetherAndRvelEndsTheTurn) {
  Robot robot;
  robot.connect();
  robot.ask(command(4, 1) + command(8, 1000) + command(12, 45));
  robot.run_fed(6s);
  EXPECT_NEAR(Truth(robot).way_mm, 1000.0, 2.0);
  EXPECT_NEAR(Truth(robot).turn_deg, 45.0, 0.3);
  robot.ask(command(12, 180));
  robot.run_fed(500ms);
  robot.ask(command(21, 10));
  robot.run_fed(2s);
  const double before_deg = Truth(robot).turn_deg;
  robot.run_fed(1s);
  EXPECT_NEAR(Truth(robot).turn_deg - before_deg, 10.0, 0.1);
}

TEST(ArcosDevice, TheOriginMovesTheHeadingGoalWithIt) {
  Robot robot;
  robot.connect();
  robot.ask(command(4, 1) + command(12, 90));
  robot.run_fed(500ms);
  robot.ask(command(7));
  robot.run_fed(5s);
  EXPECT_NEAR(Truth(robot).turn_deg, 90.0, 0.5);
}

TEST(ArcosDevice, TheWatchdogHoldsAMoveAndAPacketResumesIt) {
  Robot robot;
  robot.connect();
  robot.ask(command(4, 1) + command(6, 300) + command(8, 3000));
  robot.run(5s);
  EXPECT_EQ(robot.speed_mm_s(), 0.0);
  const double held_mm = Truth(robot).way_mm;
  EXPECT_LT(held_mm, 900.0);
  robot.run_fed(12s);
  EXPECT_NEAR(Truth(robot).way_mm, 3000.0, 2.0);
}

TEST(ArcosDevice, EStopEndsMoveAndHead) {
  Robot robot;
  robot.connect();
  robot.ask(command(4, 1) + command(8, 3000) + command(13, 90));
  robot.run_fed(1s);
  robot.ask(command(55));
  robot.run_fed(1s);
  const Truth before(robot);
  robot.run_fed(3s);
  EXPECT_EQ(Truth(robot).way_mm, before.way_mm);
  EXPECT_EQ(Truth(robot).turn_deg, before.turn_deg);
}

TEST(ArcosDevice, DeadReckonsInWholeMillimetresThatWrap) {
  Robot robot;
  robot.connect();
  robot.run(10ms);
  robot.inputs.left_m += 33.0005;
  robot.inputs.right_m += 33.0005;
  EXPECT_EQ(u16(last_sip(robot.run(200ms)), 1), 33000 - 32768);
  robot.ask(command(7));
  robot.inputs.left_m -= 0.0059;
  robot.inputs.right_m -= 0.0059;
  EXPECT_EQ(u16(last_sip(robot.run(200ms)), 1), 0x7FFF - 4) << "-5 in 15 bits, truncated towards zero";
}

TEST(ArcosDevice, TurnsIn4096thsOfATurn) {
  Robot robot;
  robot.connect();
  robot.run(10ms);
  const double quarter_m = robot.device.parameters().track_mm * 1e-3 * 1.5707963 / 2.0;
  robot.inputs.left_m += quarter_m;
  robot.inputs.right_m -= quarter_m;
  EXPECT_NEAR(i16(last_sip(robot.run(200ms)), 5), -1024, 1);
}

TEST(ArcosDevice, StopButtonCutsTheMotorsUntilEnabledAgain) {
  Robot robot;
  robot.connect();
  robot.ask(command(4, 1) + command(11, 200));
  robot.run(500ms);
  robot.device.set_stop_button(true);
  std::string sip = last_sip(robot.run(200ms));
  EXPECT_EQ(robot.speed_mm_s(), 0.0);
  EXPECT_EQ(u16(sip, 16) & 0x61, 0x60);
  EXPECT_EQ(u16(sip, 12), 0x0101);
  robot.ask(command(4, 1));
  EXPECT_FALSE(robot.device.motors_on());
  robot.device.set_stop_button(false);
  robot.run(200ms);
  EXPECT_EQ(robot.speed_mm_s(), 0.0);
  robot.ask(command(4, 1));
  sip = last_sip(robot.run(300ms));
  EXPECT_EQ(u16(sip, 16) & 0x61, 0x01);
}

TEST(ArcosDevice, BumpersAndStallsHaveTheirBits) {
  Robot robot;
  robot.connect();
  robot.device.press_bumpers(0b00001, 0b00100, robot.now + 1s);
  robot.inputs.left_stall = true;
  EXPECT_EQ(u16(last_sip(robot.run(300ms)), 12), 1 << 9 | 1 << 3 | 1);
  robot.inputs.left_stall = false;
  robot.run(1s);
  EXPECT_EQ(u16(last_sip(robot.run(300ms)), 12), 0);
}

TEST(ArcosDevice, BumpStallStopsWhenAskedTo) {
  Robot robot;
  robot.connect();
  robot.ask(command(4, 1) + command(44, 3) + command(11, 300));
  robot.run(1500ms);
  robot.device.press_bumpers(1, 0, robot.now + 500ms);
  const std::string sip = last_sip(robot.run(450ms));
  EXPECT_EQ(robot.speed_mm_s(), 0.0);
  EXPECT_EQ(u16(sip, 12) & 0x0101, 0x0101);
}

TEST(ArcosDevice, SendsOnlyNewSonarReadingsOfArraysThatAreOn) {
  Robot robot;
  robot.connect();
  robot.run(90ms);
  robot.device.add_sonar(3, 1.5);
  robot.device.add_sonar(11, 5.0);
  std::string sip = last_sip(robot.run(90ms));
  ASSERT_EQ(u8(sip, 19), 2);
  EXPECT_EQ(u8(sip, 20), 3);
  EXPECT_EQ(u16(sip, 21), 1500);
  EXPECT_EQ(u16(sip, 24), 5000);
  EXPECT_EQ(u8(last_sip(robot.run(200ms)), 19), 0);
  robot.ask(command(28, 2 << 1));  // the rear array off
  robot.device.add_sonar(3, 1.5);
  robot.device.add_sonar(11, 5.0);
  EXPECT_EQ(u8(last_sip(robot.run(120ms)), 19), 1);
}

TEST(ArcosDevice, StreamsEncodersAndIo) {
  Robot robot;
  robot.connect();
  robot.ask(command(19, 2) + command(40, 1));
  robot.inputs.left_m = 1.0;
  int encoders = 0;
  int ios = 0;
  for (const std::string& payload : packets(robot.run(570ms))) {
    encoders += u8(payload, 0) == 0x90 ? 1 : 0;
    ios += u8(payload, 0) == 0xF0 ? 1 : 0;
    if (u8(payload, 0) == 0x90) {
      EXPECT_EQ(u16(payload, 1) | u16(payload, 3) << 16, 132000);
    }
  }
  EXPECT_GE(encoders, 4);
  EXPECT_EQ(ios, 1);
}

}  // namespace
}  // namespace topo::sim
