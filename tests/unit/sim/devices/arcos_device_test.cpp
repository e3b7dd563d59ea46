// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/devices/arcos_device.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/unit/sim/devices/device_tools.hpp"

namespace topo::sim {
namespace {

using namespace std::chrono_literals;

std::string from_hex(const std::string& hex) {
  std::string out;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 3) {
    out.push_back(static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  }
  return out;
}

/// A host's command, framed by hand.
std::string command(int number) { return arcos::PacketBuilder(static_cast<std::uint8_t>(number)).frame(); }
std::string command(int number, int value) {
  arcos::PacketBuilder b(static_cast<std::uint8_t>(number));
  return b.u8(value < 0 ? 0x1B : 0x3B).u16(std::abs(value)).frame();
}

/// A robot on a floor without end: its wheels do what they are told.
struct Robot {
  explicit Robot(arcos::Parameters parameters = arcos::p3dx_parameters())
      : device(std::move(parameters), 1) {}

  std::string ask(const std::string& text) {
    send(device, text, now);
    return drain(device, now);
  }
  std::string run(SimTime time) {
    const SimTime end = now + time;
    for (constexpr SimTime kStep = 1ms; now < end; now += kStep) {
      const auto wheels = device.control(now, kStep, inputs);
      inputs.left_mps = wheels.left_mps;
      inputs.right_mps = wheels.right_mps;
      inputs.left_m += wheels.left_mps * 1e-3;
      inputs.right_m += wheels.right_mps * 1e-3;
    }
    return drain(device, now);
  }
  /// As run, with a PULSE now and then, so that the watchdog never bites.
  void run_fed(SimTime time) {
    for (constexpr SimTime kPulse = 100ms; time > 0ms; time -= kPulse) {
      ask(command(0));
      run(kPulse);
    }
  }
  void connect() {
    ask(command(0) + command(1) + command(2));
    ask(command(1, 1));
  }
  double speed_mm_s() const { return (inputs.left_mps + inputs.right_mps) * 500.0; }

  ArcosDevice device;
  BaseInputs inputs;
  SimTime now{0};
};

/// Payloads of the packets in a stream, checksums asserted.
std::vector<std::string> packets(const std::string& stream) {
  std::vector<std::string> out;
  std::size_t at = 0;
  while (at + 3 <= stream.size()) {
    EXPECT_EQ(stream.substr(at, 2), "\xFA\xFB");
    const auto count = static_cast<std::size_t>(static_cast<unsigned char>(stream[at + 2]));
    const std::string payload = stream.substr(at + 3, count - 2);
    const auto sum = arcos::checksum(payload);
    EXPECT_EQ(stream.substr(at + 1 + count, 2),
              (std::string{static_cast<char>(sum >> 8), static_cast<char>(sum & 0xFF)}));
    out.push_back(payload);
    at += count + 3;
  }
  EXPECT_EQ(at, stream.size());
  return out;
}

int u8(const std::string& payload, std::size_t at) { return static_cast<unsigned char>(payload.at(at)); }
int u16(const std::string& payload, std::size_t at) { return u8(payload, at) | u8(payload, at + 1) << 8; }
int i16(const std::string& payload, std::size_t at) { return static_cast<std::int16_t>(u16(payload, at)); }

std::string last_sip(const std::string& stream) {
  std::string sip;
  for (const std::string& payload : packets(stream)) {
    if ((u8(payload, 0) & 0xF0) == 0x30) sip = payload;
  }
  return sip;
}

// ---- the vectors of PROTOCOLS section 16 ----

TEST(ArcosVectors, DecodesHostCommands) {
  struct Case {
    const char* hex;
    int number;
    bool argument;
    int value;
  };
  const std::vector<Case> cases{{"fa fb 03 00 00 00", 0, false, 0},
                                {"fa fb 06 01 3b 01 00 02 3b", 1, true, 1},
                                {"fa fb 06 02 3b 01 00 03 3b", 2, true, 1},
                                {"fa fb 06 04 3b 01 00 05 3b", 4, true, 1},
                                {"fa fb 06 0b 3b fa 00 05 3b", 11, true, 250},
                                {"fa fb 06 0b 1b fa 00 05 1b", 11, true, -250},
                                {"fa fb 06 15 1b 14 00 29 1b", 21, true, -20},
                                {"fa fb 06 06 3b f4 01 fa 3c", 6, true, 500},
                                {"fa fb 06 05 1b 2c 01 31 1c", 5, true, -300},
                                {"fa fb 06 20 3b fb 0a 1b 45", 32, true, 0x0AFB},
                                {"fa fb 03 1d 00 1d", 29, false, 0},
                                {"fa fb 03 37 00 37", 55, false, 0},
                                {"fa fb 03 07 00 07", 7, false, 0},
                                {"fa fb 06 1c 3b 00 00 1c 3b", 28, true, 0},
                                {"fa fb 06 12 3b 01 00 13 3b", 18, true, 1},
                                {"fa fb 06 13 3b 02 00 15 3b", 19, true, 2},
                                {"fa fb 06 32 3b 04 00 36 3b", 50, true, 4}};
  for (const Case& c : cases) {
    arcos::Receiver receiver;
    std::vector<arcos::Command> got;
    const std::string bytes = from_hex(c.hex);
    receiver.feed({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                  [&](const arcos::Command& decoded) { got.push_back(decoded); });
    ASSERT_EQ(got.size(), 1U) << c.hex;
    EXPECT_EQ(got[0].number, c.number) << c.hex;
    EXPECT_EQ(got[0].has_argument, c.argument) << c.hex;
    EXPECT_EQ(got[0].value, c.value) << c.hex;
  }
}

TEST(ArcosVectors, Sync2Reply) {
  Robot robot;
  EXPECT_EQ(robot.ask(command(0)), from_hex("fa fb 03 00 00 00"));
  EXPECT_EQ(robot.ask(command(1)), from_hex("fa fb 03 01 00 01"));
  EXPECT_EQ(robot.ask(command(2)),
            from_hex("fa fb 1a 02 73 69 6d 62 6f 74 00 50 69 6f 6e 65 65 72 00 70 33 64 78 "
                     "2d 73 68 00 43 a9"));
}

TEST(ArcosVectors, SipPacket) {
  arcos::Sip sip;
  sip.moving = true;
  sip.x_mm = 32766;
  sip.y_mm = 5;
  sip.heading_counts = -1024;
  sip.left_mm_s = 195;
  sip.right_mm_s = 205;
  sip.battery_dv = 127;
  sip.flags = 7;
  sip.sonar = {{3, 1500}, {4, 4995}};
  sip.rotation_ddeg_s = 16;
  EXPECT_EQ(
      arcos::sip_packet(sip),
      from_hex(
          "fa fb 28 33 fe 7f 05 00 00 fc c3 00 cd 00 7f 00 00 00 00 07 00 00 02 03 dc 05 04 83 13 00 00 00 "
          "ff 00 7f 00 00 10 00 00 00 55 85"));
}

TEST(ArcosVectors, EncoderPacket) {
  EXPECT_EQ(arcos::encoder_packet(-12345, 70000), from_hex("fa fb 0b 90 c7 cf ff ff 70 11 01 00 71 37"));
}

// ---- framing ----

TEST(ArcosReceiver, FindsPacketsInGarbage) {
  Robot robot;
  EXPECT_EQ(robot.ask("WMS2\r" + command(0)), command(0)) << "the radio-modem attach is skipped";
  EXPECT_EQ(robot.ask("\xFA" + command(1)), command(1)) << "FA FA FB";
  std::string broken = command(11, 250);
  broken.back() = 'x';
  EXPECT_EQ(robot.ask(broken), "");
  EXPECT_EQ(robot.device.bad_packets(), 1U);
  EXPECT_EQ(robot.ask(std::string("\xFA\xFB\x20") + command(2)).size(), 0U) << "count longer than what came";
  robot.ask(std::string(40, '\0'));
  EXPECT_EQ(robot.device.state(), ArcosDevice::State::kSynced) << "the packet inside the candidate is found";
}

// ---- session ----

TEST(ArcosDevice, AnswersFFToTheWrongOrderAndStartsAgain) {
  Robot robot;
  robot.ask(command(0));
  EXPECT_EQ(packets(robot.ask(command(2))).at(0), "\xFF");
  EXPECT_EQ(packets(robot.ask(command(1))).at(0), "\xFF");
  EXPECT_EQ(robot.ask(command(0) + command(1)), command(0) + command(1));
}

TEST(ArcosDevice, CloseWhileWaitingIsNoSync2) {
  Robot robot;
  robot.ask(command(0) + command(1));
  EXPECT_EQ(robot.ask(command(2, 1)), "");
  EXPECT_EQ(packets(robot.ask(command(2))).at(0), "\xFF");
}

TEST(ArcosDevice, StreamsSipsEvery100MsWithTheMotorsOff) {
  Robot robot;
  robot.connect();
  const auto sips = packets(robot.run(1070ms));
  EXPECT_GE(sips.size(), 10U);
  EXPECT_LE(sips.size(), 11U);
  EXPECT_EQ(u8(sips.back(), 0), 0x32);
  EXPECT_EQ(u16(sips.back(), 16), 0x0006) << "sonar on, motors off";
}

TEST(ArcosDevice, SipsLeave20To60MsAfterTheyWereMade) {
  Robot robot;
  robot.connect();
  for (int i = 0; i < 50; ++i) {
    robot.run(0ms);
    SimTime made{0};
    while (robot.device.output().bytes() == 0) robot.run(1ms);
    made = robot.now;
    SimTime left = made;
    while (drain(robot.device, left).empty()) left += 100us;
    EXPECT_GE(left - made, 18ms);
    EXPECT_LE(left - made, 61ms);
  }
}

TEST(ArcosDevice, AStaleSessionAnswersSync0WithSips) {
  Robot robot;
  robot.connect();
  robot.run(300ms);
  robot.device.client_gone(robot.now);
  EXPECT_EQ(robot.ask(command(0)), "") << "it is a PULSE to the robot";
  EXPECT_EQ(u8(last_sip(robot.run(200ms)), 0), 0x32);
  robot.ask(command(2, 1));
  robot.run(200ms);
  EXPECT_EQ(robot.ask(command(0)), command(0));
}

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

TEST(ArcosDevice, ConfigPacketCarriesTheModel) {
  Robot robot(arcos::p3at_parameters());
  robot.connect();
  const std::string config = packets(robot.ask(command(18, 1))).at(0);
  EXPECT_EQ(config.substr(0, 24), std::string("\x20Pioneer\0p3at-sh\0SA0456\0", 24));
  EXPECT_EQ(u8(config, 24), 1) << "four motors";
  EXPECT_EQ(u16(config, 25), 360);
  EXPECT_EQ(u16(config, 27), 1500);
  const std::size_t after_name = 35 + 7;
  EXPECT_EQ(config.substr(35, 7), std::string("simbot\0", 7));
  EXPECT_EQ(u8(config, after_name), 100) << "SIP cycle";
  EXPECT_EQ(u16(config, after_name + 12), 2000) << "watchdog";
}

TEST(ArcosDevice, HostBaudHoldsUntilTheSessionCloses) {
  Robot robot;
  EXPECT_EQ(robot.device.line_rate_bps(), 9600U);
  robot.connect();
  robot.ask(command(50, 4));
  EXPECT_EQ(robot.device.line_rate_bps(), 115200U);
  robot.ask(command(50, 9));
  EXPECT_EQ(robot.device.line_rate_bps(), 115200U);
  robot.ask(command(2));
  EXPECT_EQ(robot.device.line_rate_bps(), 9600U);
}

TEST(ArcosDevice, AResetSaysFFAndForgetsTheSession) {
  Robot robot;
  robot.connect();
  robot.device.controller_reset(robot.now);
  EXPECT_EQ(packets(drain(robot.device, robot.now)).at(0), "\xFF");
  EXPECT_EQ(robot.run(500ms), "");
  EXPECT_EQ(robot.ask(command(0)), command(0));
}

TEST(ArcosDevice, AnyCutOfTheInputGivesTheSameOutput) {
  const std::string script = "WMS2\r" + command(0) + command(2) + command(0) + command(1) + command(2) +
                             "\xFA\xFA" + command(1, 1) + "junk\xFA\xFB\x05" + command(18, 1) +
                             command(4, 1) + command(11, -150) + command(62, 1) + command(19, 2);
  const auto run = [&script](const std::vector<std::size_t>& cuts) {
    Robot robot;
    send_cut(robot.device, script, cuts, robot.now);
    return drain(robot.device, robot.now) + robot.run(300ms);
  };
  const std::string whole = run({});
  ASSERT_GT(whole.size(), 200U);
  EXPECT_TRUE(rc::check([&](const std::vector<std::size_t>& cuts) { RC_ASSERT(run(cuts) == whole); }));
}

TEST(ArcosDevice, SurvivesAnyBytes) {
  EXPECT_TRUE(rc::check([](const std::vector<std::uint8_t>& bytes, bool framed) {
    Robot robot;
    robot.connect();
    for (std::size_t at = 0; at < bytes.size(); at += 4) {
      std::string piece(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                        bytes.begin() + static_cast<std::ptrdiff_t>(std::min(at + 4, bytes.size())));
      if (framed) {
        arcos::PacketBuilder builder(static_cast<std::uint8_t>(piece[0]));
        for (const char c : piece.substr(1)) builder.u8(c);
        piece = builder.frame();
      }
      send(robot.device, piece, robot.now);
      robot.run(5ms);
    }
    RC_ASSERT(std::isfinite(robot.inputs.left_mps));
    RC_ASSERT(std::abs(robot.speed_mm_s()) <= 1500.0);
  }));
}

}  // namespace
}  // namespace topo::sim
