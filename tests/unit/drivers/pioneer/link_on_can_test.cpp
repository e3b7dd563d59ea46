// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "drivers/pioneer/link.hpp"
#include "tests/unit/drivers/pioneer/arcos_on_can.hpp"

namespace topo::pioneer {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using types::Duration;
using types::Stamp;

const std::string kSetVPacket = frame_bytes("fa fb 06 06 3b f4 01 fa 3c");
const std::string kVelZeroPacket = frame_bytes("fa fb 06 0b 3b 00 00 0b 3b");
const std::string kRvelZeroPacket = frame_bytes("fa fb 06 15 3b 00 00 15 3b");
const std::string kClosePacket = frame_bytes("fa fb 06 02 3b 01 00 03 3b");

// The link: paced commands, and a stop that waits for nothing.
class LinkOnCan : public ArcosOnCan {
 protected:
  Counters counters;
  Link link{std::move(stream), counters};

  void run(Duration duration) {
    for (const Stamp end = bus.now + duration; bus.now < end;) {
      ASSERT_TRUE(link.pump());
      ASSERT_TRUE(link.receive(std::min(end, link.next_send()) - bus.now));
      while (link.next_packet()) {
      }
    }
  }
};

TEST_F(LinkOnCan, TheNextPacketWaitsForTheOneBeforeAndTheSpacing) {
  robot_answers(milliseconds(10));
  link.outbox().push(encode(Command::kEnable, 1));
  link.outbox().push(encode(Command::kSetV, 500));
  run(milliseconds(50));
  ASSERT_EQ(robot_heard.size(), 2U);
  const auto& frames = bus.sent;  // first and consecutive of each
  ASSERT_EQ(frames.size(), 4U);
  EXPECT_EQ(frames[2].when - frames[1].when, milliseconds(4));
  EXPECT_TRUE(link.all_sent());
}

TEST_F(LinkOnCan, AStopOvertakesAndDropsInterruptedSetpoints) {
  robot_answers(milliseconds(30));
  link.outbox().push(encode(Command::kSetV, 500));
  run(milliseconds(10));
  link.outbox().set_estop();
  ASSERT_TRUE(link.pump());
  ASSERT_EQ(bus.sent.back().id, kStopId);
  run(milliseconds(100));
  EXPECT_THAT(robot_heard, ElementsAre(kSetVPacket));
  robot_heard.clear();
  link.outbox().set_velocity({.v_mmps = 250, .omega_degps = 0});
  run(milliseconds(10));
  link.outbox().set_estop();
  run(milliseconds(100));
  EXPECT_THAT(robot_heard, ElementsAre(kRvelZeroPacket));
  EXPECT_EQ(bus.sent_on(kStopId).size(), 4U);  // each twice
}

TEST_F(LinkOnCan, AStandstillDoesNotWaitForASetpointThatIsBlocked) {
  link.outbox().set_velocity({.v_mmps = 250, .omega_degps = 10});
  run(milliseconds(30));
  ASSERT_EQ(bus.sent.size(), 1U);  // nobody answers its first frame
  const Stamp order = bus.now;
  link.outbox().set_velocity({});
  ASSERT_TRUE(link.pump());
  ASSERT_THAT(bus.sent_on(kStopId), ElementsAre("\x1D", "\x1D"));
  EXPECT_EQ(bus.sent.back().when, order);
  robot_answers();
  run(milliseconds(30));
  EXPECT_THAT(robot_heard, ElementsAre(kVelZeroPacket, kRvelZeroPacket));
  EXPECT_EQ(bus.sent_on(kStopId).size(), 2U);
}

TEST_F(LinkOnCan, WhatWasClearedDoesNotComeBackAfterAStop) {
  robot_answers(milliseconds(30));
  link.outbox().push(encode(Command::kSetV, 500));
  run(milliseconds(10));
  link.clear();
  link.outbox().set_estop();
  run(milliseconds(100));
  EXPECT_TRUE(robot_heard.empty());
}

TEST_F(LinkOnCan, AStopThatWaitsForRoomIsNotDoneAndNotQueuedTwice) {
  bus.full = true;
  link.outbox().set_estop();
  ASSERT_TRUE(link.pump());
  EXPECT_FALSE(link.all_sent());
  link.outbox().set_estop();
  ASSERT_TRUE(link.pump());
  EXPECT_TRUE(link.outbox().empty());
  bus.full = false;
  run(milliseconds(20));
  EXPECT_TRUE(link.all_sent());
  EXPECT_EQ(bus.sent_on(kStopId).size(), 2U);
}

TEST_F(LinkOnCan, BusFaultsAreCountedOverAllConnections) {
  counters.bus[io::BusFault::kPassive] = 2;  // of a connection before
  io::CanError error;
  error.passive = true;
  bus.report(error);
  bus.report(error, milliseconds(20));
  run(milliseconds(50));
  EXPECT_EQ(counters.bus[io::BusFault::kPassive], 4U);
}

TEST_F(LinkOnCan, TheLastWordWaitsForTheTransferUnderWay) {
  robot_answers(milliseconds(10));
  link.outbox().push(encode(Command::kSetV, 500));
  ASSERT_TRUE(link.pump());
  ASSERT_TRUE(link.send_at_once(encode(Command::kClose, 1)));
  run(milliseconds(20));
  EXPECT_THAT(robot_heard, ElementsAre(kSetVPacket, kClosePacket));
  EXPECT_GE(bus.sent[2].when - bus.sent[1].when, milliseconds(4));  // the controller's spacing
}

}  // namespace
}  // namespace topo::pioneer
