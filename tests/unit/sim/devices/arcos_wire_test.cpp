// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The simulated base on the line: the vectors of PROTOCOLS section 16, framing, the session and what it
// streams; arcos_device_test.cpp has what it does.
#include <rapidcheck.h>

#include "tests/unit/sim/devices/arcos_robot.hpp"

namespace topo::sim {
namespace {

using namespace std::chrono_literals;

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
