// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Faults of devices whose bytes arrive in form and in time.
#include <gtest/gtest.h>

#include "tests/sim/devices/delay_line.hpp"
#include "tests/sim/devices/scip_device.hpp"
#include "tests/unit/sim/devices/arcos_robot.hpp"

namespace topo::sim {
namespace {

using namespace std::chrono_literals;

constexpr int kVel = 11, kEStop = 55, kEnable = 4;

struct Driving : Robot {
  Driving() {
    connect();
    ask(command(kEnable, 1) + command(kVel, 300));
    run_fed(2s);
    EXPECT_NEAR(speed_mm_s(), 300.0, 5.0);
  }
};

TEST(DelayLine, HoldsBytesInOrderAndLetsThemGoAtItsEnd) {
  DelayLine line;
  line.set(1s, 0.0, 0s);
  line.push("a", 0s);
  line.push("b", 500ms);
  EXPECT_EQ(line.take(999ms), "");
  EXPECT_EQ(line.take(1s), "a");
  line.set(0s, 0.0, 1s);
  EXPECT_FALSE(line.active());
  EXPECT_EQ(line.take(1s), "b");
}

TEST(DelayLine, GrowsUpToItsBound) {
  DelayLine line;
  line.set(0s, 0.5, 0s);
  line.push("a", 2s);
  EXPECT_EQ(line.take(2999ms), "");
  EXPECT_EQ(line.take(3s), "a");
  line.push("b", 1000s);
  EXPECT_EQ(line.take(1030s), "b");
}

TEST(BaseFaults, ADisobedientBaseHearsAllButMotion) {
  Driving robot;
  robot.device.faults().disobeys = true;
  robot.ask(command(kEStop) + command(kVel, 0));
  robot.run_fed(3s);
  EXPECT_NEAR(robot.speed_mm_s(), 300.0, 5.0) << "PULSE feeds its watchdog";
  robot.run(4s);
  EXPECT_EQ(robot.speed_mm_s(), 0.0) << "the watchdog stops it in silence";
}

TEST(BaseFaults, ALostCommandDoesNotFeedTheWatchdog) {
  Driving robot;
  robot.device.faults().lost_commands = 1.0;
  robot.run_fed(5s);
  EXPECT_EQ(robot.speed_mm_s(), 0.0);
}

TEST(BaseFaults, ADeadEncoderCountsNoMoreAndGoesOnWhereItWas) {
  EncoderFault encoder;
  EXPECT_EQ(encoder.count_m(1.0), 1.0);
  encoder.set(true);
  EXPECT_EQ(encoder.count_m(3.0), 1.0);
  encoder.set(false);
  EXPECT_EQ(encoder.count_m(3.5), 1.5);
}

TEST(BaseFaults, LiesStandInValidPackets) {
  Driving robot;
  robot.device.faults().lie = StatusLie::kSpeed;
  robot.device.faults().lie_value = -6.1;
  const std::string sip = last_sip(robot.run(300ms));
  EXPECT_EQ(i16(sip, 7), -6100);
  EXPECT_EQ(i16(sip, 9), -6100);
}

TEST(BaseFaults, ABatteryFallsWithTime) {
  Robot robot;
  robot.device.set_battery(12.0, 0.5, robot.now);
  robot.connect();
  EXPECT_NEAR(u8(last_sip(robot.run(2s)), 11), 110, 2);
}

TEST(BaseFaults, StuckWheelsStandAndSaySo) {
  Driving robot;
  robot.device.faults().stall_left = true;
  robot.device.faults().stalled_until = robot.now + 1s;
  const std::string sip = last_sip(robot.run(300ms));
  EXPECT_EQ(robot.speed_mm_s(), 0.0);
  EXPECT_EQ(u8(sip, 12) & 1, 1);
}

TEST(BaseFaults, PacketsLeaveTwiceOrOnceMore) {
  Robot robot;
  robot.connect();
  robot.run(1s);
  const std::size_t usual = packets(robot.run(2s)).size();
  robot.device.output().repeat(2);
  EXPECT_NEAR(static_cast<double>(packets(robot.run(2s)).size()), 2.0 * static_cast<double>(usual), 3.0);
  robot.device.output().repeat(1);
  robot.device.output().replay(5);
  EXPECT_NEAR(static_cast<double>(packets(robot.run(2s)).size()), 2.0 * static_cast<double>(usual) - 5.0,
              3.0);
}

scip::Turn turn_of(std::uint32_t range_mm) {
  scip::Turn turn;
  turn.beams.resize(1081);
  for (scip::Beam& beam : turn.beams) beam.echoes[0].range_mm = range_mm;
  return turn;
}

TEST(ScanFaults, AFrozenScannerRepeatsItsPicture) {
  const ScipModelSpec& model = scip_model(ScipModel::kUtm30LxEw);
  ScanFaults faults;
  faults.frozen = true;
  EXPECT_EQ(faults.seen(turn_of(1000), model).beams[5].echoes[0].range_mm, 1000U);
  EXPECT_EQ(faults.seen(turn_of(2000), model).beams[5].echoes[0].range_mm, 1000U);
  faults.frozen = false;
  EXPECT_EQ(faults.seen(turn_of(3000), model).beams[5].echoes[0].range_mm, 3000U);
}

TEST(ScanFaults, AMaskHidesItsSectorAlone) {
  const ScipModelSpec& model = scip_model(ScipModel::kUtm30LxEw);
  ScanFaults faults;
  faults.mask = Mask{0.0, 1.0, 30};
  const scip::Turn seen = faults.seen(turn_of(1000), model);
  EXPECT_EQ(seen.beams[540].echoes[0].range_mm, 30U) << "straight ahead";
  EXPECT_EQ(seen.beams[539].echoes[0].range_mm, 1000U);
  EXPECT_EQ(seen.beams[540 + 240].echoes[0].range_mm, 1000U) << "60 degrees to the left";
}

TEST(ScanFaults, OtherStepsComeInMidStream) {
  ScipDevice device({});
  EXPECT_FALSE(device.change_steps(100, 500)) << "it does not stream";
  send(device, "MD0000108001000\n", 0s);
  drain(device, 0s);
  EXPECT_FALSE(device.change_steps(0, 5000));
  ASSERT_TRUE(device.change_steps(100, 500));
  device.deliver(turn_of(1000), 25ms);
  const std::string scan = drain(device, 100ms);
  EXPECT_TRUE(scan.starts_with("MD0100050001000\n99b\n")) << scan.substr(0, 30);
  EXPECT_NEAR(static_cast<double>(scan.size()), 3 * 401, 80);
}

}  // namespace
}  // namespace topo::sim
