// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Stops on a CAN bus whose time only waiting moves: what they overtake, what they end, and what follows them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/unit/drivers/pioneer/arcos_on_can.hpp"

namespace topo::pioneer {
namespace {

using io::BusFault;
using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;
using types::Errc;
using types::Stamp;

TEST_F(ArcosOnCan, AStopIsOnTheWireAtOnceAndEndsTheTransferUnderWay) {
  ASSERT_TRUE(write(kVelPacket));
  ASSERT_FALSE(stream->ready());
  const Stamp order = bus.now;
  ASSERT_TRUE(write(kEStopPacket));
  ASSERT_GE(bus.sent.size(), 2U);
  EXPECT_EQ(bus.sent[1].id, kStopId);
  EXPECT_EQ(bus.sent[1].data, "\x37");
  EXPECT_EQ(bus.sent[1].when, order);
  EXPECT_TRUE(bus.sent[1].first);
  EXPECT_TRUE(stream->ready());
  EXPECT_EQ(stream->faults()[BusFault::kInterrupted], 1U);
  // Flow control that comes late brings nothing of the given-up packet on the wire.
  bus.arrive(kInId, kFlow);
  ASSERT_TRUE(read());
  EXPECT_EQ(bus.sent_on(kOutId).size(), 1U);
  ASSERT_TRUE(write(frame_bytes("fa fb 03 1d 00 1d")));
  EXPECT_EQ(bus.sent.back().data, "\x1D");
}

// The rest of a finished setpoint may wait in the queue where nobody can call it back: the robot has it
// whole after the stop that overtook it, and needs another one.
TEST_F(ArcosOnCan, AfterTheLastFrameThatWaitedInTheQueueComesAStop) {
  robot_answers();
  ASSERT_TRUE(write(kVelPacket));
  bus.blocked = true;
  ASSERT_TRUE(read());
  ASSERT_TRUE(stream->ready());  // for the queue has all of it
  ASSERT_TRUE(write(kEStopPacket));
  bus.unblock();
  ASSERT_THAT(robot_heard, ElementsAre(kVelPacket));
  ASSERT_EQ(bus.sent.size(), 4U);
  EXPECT_EQ(bus.sent[1].id, kStopId);
  EXPECT_EQ(bus.sent[2].id, kOutId);
  EXPECT_EQ(bus.sent[3].id, kStopId);
  EXPECT_EQ(bus.sent[3].data, "\x37");
}

TEST_F(ArcosOnCan, TheStopBehindAFullQueueIsTriedAgain) {
  robot_answers();
  ASSERT_TRUE(write(kVelPacket));
  bus.blocked = true;
  bus.capacity = 1;
  ASSERT_TRUE(read());
  ASSERT_TRUE(write(kEStopPacket));
  bus.unblock();
  ASSERT_EQ(bus.sent.back().id, kOutId);
  EXPECT_FALSE(stream->ready());
  ASSERT_TRUE(read());
  EXPECT_EQ(bus.sent.back().id, kStopId);
  EXPECT_THAT(bus.sent_on(kStopId), ElementsAre("\x37", "\x37"));
  EXPECT_TRUE(stream->ready());
}

TEST_F(ArcosOnCan, AStopThatFindsNoRoomGoesBeforeAllElseWhenThereIs) {
  robot_answers();
  ASSERT_TRUE(write(kVelPacket));
  bus.full = true;
  ASSERT_TRUE(write(kEStopPacket));
  EXPECT_FALSE(stream->ready());
  ASSERT_TRUE(read(milliseconds(10)));
  EXPECT_TRUE(bus.sent_on(kStopId).empty());
  EXPECT_GE(stream->faults()[BusFault::kQueueFull], 10U);
  EXPECT_EQ(write(kVelPacket).error().code, Errc::kBusy);
  bus.full = false;
  const Stamp room = bus.now;
  ASSERT_TRUE(read(milliseconds(10)));  // returns when it is out
  EXPECT_TRUE(stream->ready());
  EXPECT_LE(bus.now - room, milliseconds(1));
  ASSERT_EQ(bus.sent.size(), 3U);  // and nothing of the setpoint
  EXPECT_EQ(bus.sent[1].id, kStopId);
}

TEST_F(ArcosOnCan, AStopThatCannotBeSentIsAnErrorEveryTime) {
  bus.full = true;
  const Stamp order = bus.now;
  std::string fault;
  while (fault.empty() && bus.now - order < milliseconds(500)) {
    const auto written = write(kEStopPacket);
    if (!written) fault = written.error().message;
    const auto got = read(milliseconds(30));
    if (!got) fault = got.error().message;
  }
  EXPECT_THAT(fault, HasSubstr("a stop did not get out"));
  EXPECT_LE(bus.now - order, milliseconds(101));
}

TEST_F(ArcosOnCan, AnEmergencyStopThatWaitsIsNotSoftenedByAnother) {
  bus.full = true;
  ASSERT_TRUE(write(kEStopPacket));
  ASSERT_TRUE(write(frame_bytes("fa fb 03 1d 00 1d")));
  bus.full = false;
  ASSERT_TRUE(read());
  EXPECT_THAT(bus.sent_on(kStopId), ElementsAre("\x37", "\x37"));
}

}  // namespace
}  // namespace topo::pioneer
