// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// ARCOS on a CAN bus whose time only waiting moves; at the far end the simulator's own segmentation.
#include "drivers/pioneer/arcos_can_stream.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>

#include "tests/unit/drivers/pioneer/arcos_on_can.hpp"

namespace topo::pioneer {
namespace {

using io::BusFault;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;
using types::Errc;
using types::Stamp;

TEST_F(ArcosOnCan, AShortPacketIsOneFrame) {
  ASSERT_TRUE(write(frame_bytes("fa fb 03 00 00 00")));
  EXPECT_THAT(bus.sent_on(kOutId), ElementsAre(frame_bytes("06 fa fb 03 00 00 00 cc")));
  EXPECT_TRUE(stream->ready());
}

TEST_F(ArcosOnCan, ALongPacketGoesOutWithFlowControl) {
  robot_answers(milliseconds(2));
  ASSERT_TRUE(write(kVelPacket));
  EXPECT_FALSE(stream->ready());
  EXPECT_EQ(write(kVelPacket).error().code, Errc::kBusy);
  const Stamp before = bus.now;
  const auto got = read(milliseconds(50));
  ASSERT_TRUE(got);
  EXPECT_EQ(got->bytes, 0U);
  EXPECT_EQ(bus.now - before, milliseconds(2));
  EXPECT_TRUE(stream->ready());
  EXPECT_THAT(robot_heard, ElementsAre(kVelPacket));
}

TEST_F(ArcosOnCan, NobodyThereCostsTheTransferAndNothingElse) {
  ASSERT_TRUE(write(kVelPacket));
  const Stamp before = bus.now;
  const auto got = read(milliseconds(500));
  ASSERT_TRUE(got);
  EXPECT_EQ(bus.now - before, milliseconds(100));  // N_Bs
  EXPECT_TRUE(stream->ready());
  EXPECT_EQ(stream->faults()[BusFault::kUnanswered], 1U);
}

TEST_F(ArcosOnCan, AFullQueueDelaysATransferAndEndsItAfterAWhile) {
  robot_answers();
  bus.full = true;
  ASSERT_TRUE(write(kVelPacket));
  ASSERT_TRUE(read(milliseconds(30)));
  bus.full = false;
  ASSERT_TRUE(read(milliseconds(30)));
  EXPECT_THAT(robot_heard, ElementsAre(kVelPacket));
  bus.full = true;
  ASSERT_TRUE(write(kVelPacket));
  ASSERT_TRUE(read(milliseconds(500)));
  EXPECT_TRUE(stream->ready());
  EXPECT_EQ(stream->faults()[BusFault::kUnanswered], 1U);
}

TEST_F(ArcosOnCan, AReceivedPacketHasTheStampOfItsLastFrame) {
  bus.arrive(kBeatId, frame_bytes("02 05 00 00 10 00 00 00"));
  robot_sends(kStatusPacket);
  const auto got = read();
  ASSERT_TRUE(got);
  EXPECT_EQ(text, kStatusPacket);
  EXPECT_EQ(got->stamp, bus.now);
  EXPECT_THAT(bus.sent_on(kOutId), ElementsAre(kFlow));
}

TEST_F(ArcosOnCan, ASmallBufferGetsThePacketInPieces) {
  robot_sends(kStatusPacket);
  std::string all;
  std::array<std::byte, 10> small{};
  while (all.size() < kStatusPacket.size()) {
    const auto got = stream->read(small, milliseconds(20));
    ASSERT_TRUE(got);
    ASSERT_GT(got->bytes, 0U);
    all.append(reinterpret_cast<const char*>(small.data()), got->bytes);
  }
  EXPECT_EQ(all, kStatusPacket);
}

TEST_F(ArcosOnCan, BothDirectionsRunAtOnce) {
  robot_answers(milliseconds(3));
  ASSERT_TRUE(write(kVelPacket));
  robot_sends(kStatusPacket);
  EXPECT_EQ(read_ten_times(), kStatusPacket);
  EXPECT_THAT(robot_heard, ElementsAre(kVelPacket));
}

/// A bus on which a frame always waits already.
class FloodedPort final : public io::CanPort {
 public:
  types::Result<io::CanEvent> receive(types::Duration /*timeout*/) override {
    time_ += microseconds(250);
    if (++frames_ > 10'000) return types::fail(Errc::kIo, "nobody stopped reading");
    return io::CanEvent{io::CanFrame{kBeatId, {}, time_}};
  }
  types::Status send(std::uint16_t /*id*/, const io::CanData& /*data*/) override { return {}; }
  types::Status send_first(std::uint16_t /*id*/, const io::CanData& /*data*/) override { return {}; }
  [[nodiscard]] std::uint64_t dropped() const override { return 0; }
  [[nodiscard]] Stamp now() const override { return time_; }
  [[nodiscard]] std::string_view name() const override { return "can:flooded"; }

 private:
  Stamp time_{std::chrono::seconds(1)};
  int frames_ = 0;
};

TEST(ArcosOnAFloodedBus, ReadReturnsAtItsDeadline) {
  ArcosCanStream stream(std::make_unique<FloodedPort>(), kUnit);
  std::array<std::byte, 64> buffer{};
  const Stamp before = stream.now();
  const auto got = stream.read(buffer, milliseconds(20));
  ASSERT_TRUE(got) << got.error().message;
  EXPECT_LE(stream.now() - before, milliseconds(21));
}

// A connection that slept judges the robot's silence after a read, however short.
TEST_F(ArcosOnCan, BytesBeforeTheDeadlineAreReadAfterIt) {
  robot_sends(kStatusPacket);
  bus.now += std::chrono::seconds(1);
  ASSERT_TRUE(read(milliseconds(0)));
  EXPECT_EQ(text, kStatusPacket);
}

TEST_F(ArcosOnCan, WhatIsNoWholePacketIsDroppedAndCounted) {
  std::string wrong_sum = kStatusPacket;
  wrong_sum.back() ^= 1;
  robot_sends(wrong_sum);
  robot_sends(kStatusPacket + "x");
  robot_sends(kStatusPacket.substr(0, 30));
  robot_sends(kStatusPacket);
  EXPECT_EQ(read_ten_times(), kStatusPacket);
  EXPECT_EQ(stream->faults()[BusFault::kBadMessage], 3U);
}

TEST_F(ArcosOnCan, SurvivesAnythingAndStillHearsTheNextPacket) {
  std::mt19937 random(11);
  for (int round = 0; round < 300; ++round) {
    for (int i = 0; i < 20; ++i) {
      std::string frame(random() % 9, '\0');
      for (char& c : frame) c = static_cast<char>(random());
      bus.arrive(kInId, frame, microseconds(20 * i));
    }
    for (int i = 0; i < 8; ++i) {
      ASSERT_TRUE(read());
      ASSERT_EQ(text, "");
    }
    bus.now += milliseconds(100);
    robot_sends(kStatusPacket);
    ASSERT_TRUE(read());
    ASSERT_EQ(text, kStatusPacket);
  }
  EXPECT_GT(stream->faults()[BusFault::kBadTransfer], 1000U);
}

TEST_F(ArcosOnCan, BusOffEndsTheConnectionInPlainWords) {
  io::CanError error;
  error.bus_off = true;
  bus.report(error);
  const auto got = read();
  ASSERT_FALSE(got);
  EXPECT_EQ(got.error().code, Errc::kClosed);
  EXPECT_THAT(got.error().message, HasSubstr("bus-off"));
}

TEST_F(ArcosOnCan, WithoutAcknowledgementItEndsAfterHalfASecond) {
  io::CanError error;
  error.no_acknowledge = true;
  for (int i = 0; i < 9; ++i) bus.report(error, milliseconds(50 * i));
  bus.arrive(kBeatId, "12345678", milliseconds(450));
  ASSERT_TRUE(read(milliseconds(460)));
  for (int i = 0; i < 20; ++i) bus.report(error, milliseconds(50 * i));
  const Stamp before = bus.now;
  const auto got = read(milliseconds(2000));
  ASSERT_FALSE(got);
  EXPECT_THAT(got.error().message, HasSubstr("nobody acknowledges"));
  EXPECT_EQ(bus.now - before, milliseconds(500));
}

TEST_F(ArcosOnCan, OtherErrorsAreSurvivedAndCounted) {
  io::CanError error;
  error.passive = error.overflow = error.restarted = error.violation = error.transmit_timeout = true;
  bus.report(error);
  bus.dropped = 7;
  robot_sends(kStatusPacket);
  ASSERT_TRUE(read());
  EXPECT_EQ(text, kStatusPacket);
  const io::BusFaults faults = stream->faults();
  for (const BusFault fault : {BusFault::kPassive, BusFault::kOverflow, BusFault::kRestarted,
                               BusFault::kViolation, BusFault::kTransmitTimeout})
    EXPECT_EQ(faults[fault], 1U);
  EXPECT_EQ(faults[BusFault::kDropped], 7U);
}

TEST_F(ArcosOnCan, AnInterfaceThatGoesAwayEndsIt) {
  bus.gone = "can:scripted: the CAN interface was switched off";
  EXPECT_EQ(read().error().code, Errc::kClosed);
  EXPECT_EQ(write(kVelPacket).error().code, Errc::kClosed);
}

TEST_F(ArcosOnCan, TheLastPacketStillGoesOutWhenTheStreamIsClosed) {
  robot_answers(milliseconds(5));
  const std::string close = frame_bytes("fa fb 06 02 3b 01 00 03 3b");
  ASSERT_TRUE(write(close));
  stream.reset();
  EXPECT_THAT(robot_heard, ElementsAre(close));
}

TEST_F(ArcosOnCan, ClosingWaitsForNobodyLongerThanATenthOfASecond) {
  ASSERT_TRUE(write(kVelPacket));
  const Stamp before = bus.now;
  stream.reset();
  EXPECT_LE(bus.now - before, milliseconds(100));
}

}  // namespace
}  // namespace topo::pioneer
