// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/iso_tp.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/unit/support/hex.hpp"

namespace topo::io {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using test::Bytes;
using test::from_hex;
using test::to_bytes;
using types::Duration;
using types::Stamp;

constexpr Stamp kStart{std::chrono::seconds(100)};

Bytes bytes_of(const std::optional<CanData>& frame) { return frame ? to_bytes(frame->view()) : Bytes{}; }

Bytes any_pdu(std::size_t size) {
  return *rc::gen::container<Bytes>(
      size, rc::gen::map(rc::gen::inRange(0, 256), [](int v) { return static_cast<std::byte>(v); }));
}

/// Sender and receiver on a wire that loses the frames it is told to. Time passes by what is due.
struct Wire {
  IsoTpSender sender;
  IsoTpReceiver receiver;
  Stamp now = kStart;
  int frames = 0;
  std::function<bool(int)> lost = [](int) { return false; };
  std::vector<Bytes> arrived;
  std::vector<Stamp> consecutive;  ///< when consecutive frames went out
  std::vector<IsoTpFault> faults;

  void note(IsoTpFault fault) {
    if (fault != IsoTpFault::kNone) faults.push_back(fault);
  }
  void deliver(const CanData& frame) {
    const IsoTpReceiver::Taken taken = receiver.take(frame.view(), now);
    note(taken.fault);
    if (!taken.pdu.empty()) arrived.emplace_back(taken.pdu.begin(), taken.pdu.end());
    if (taken.reply && !lost(frames++)) note(sender.take_flow(taken.reply->view(), now));
  }
  /// Until both have nothing to do any more.
  void run() {
    for (int steps = 0; steps < 2000; ++steps) {
      while (const auto frame = sender.next(now)) {
        if (std::to_integer<unsigned>(frame->bytes[0]) >> 4U == 2) consecutive.push_back(now);
        if (!lost(frames++)) deliver(*frame);
      }
      note(sender.expire(now));
      note(receiver.expire(now));
      const Stamp next = std::min(sender.due(), receiver.deadline());
      if (next == Stamp::max()) return;
      now = std::max(now, next);
    }
    FAIL() << "the transfer never ends";
  }
};

// PROTOCOLS section 16.
TEST(IsoTp, SendsTheVectors) {
  IsoTpSender sender;
  ASSERT_TRUE(sender.begin(from_hex("fa fb 03 37 00 37")));
  EXPECT_EQ(bytes_of(sender.next(kStart)), from_hex("06 fa fb 03 37 00 37 cc"));
  EXPECT_TRUE(sender.idle());

  ASSERT_TRUE(sender.begin(from_hex("fa fb 06 0b 3b fa 00 05 3b")));
  EXPECT_EQ(bytes_of(sender.next(kStart)), from_hex("10 09 fa fb 06 0b 3b fa"));
  EXPECT_EQ(sender.next(kStart), std::nullopt);
  EXPECT_EQ(sender.take_flow(from_hex("30 00 00 cc cc cc cc cc"), kStart), IsoTpFault::kNone);
  EXPECT_EQ(bytes_of(sender.next(kStart)), from_hex("21 00 05 3b cc cc cc cc"));
  EXPECT_TRUE(sender.idle());
}

TEST(IsoTp, ReceivesTheVectorPaddedOrNot) {
  for (const char* last : {"26 55 85 cc cc cc cc cc", "26 55 85 00 00 00 00 00", "26 55 85"}) {
    IsoTpReceiver receiver;
    const auto first = receiver.take(from_hex("10 2b fa fb 28 33 fe 7f"), kStart);
    EXPECT_EQ(bytes_of(first.reply), from_hex("30 00 00 cc cc cc cc cc"));
    for (const char* frame : {"21 05 00 00 fc c3 00 cd", "22 00 7f 00 00 00 00 07", "23 00 00 02 03 dc 05 04",
                              "24 83 13 00 00 00 ff 00", "25 7f 00 00 10 00 00 00"}) {
      const auto taken = receiver.take(from_hex(frame), kStart);
      EXPECT_TRUE(taken.pdu.empty() && !taken.reply && taken.fault == IsoTpFault::kNone);
    }
    const auto done = receiver.take(from_hex(last), kStart);
    EXPECT_EQ(
        to_bytes(done.pdu),
        from_hex(
            "fa fb 28 33 fe 7f 05 00 00 fc c3 00 cd 00 7f 00 00 00 00 07 00 00 02 03 dc 05 04 83 13 00 00 "
            "00 ff 00 7f 00 00 10 00 00 00 55 85"));
    EXPECT_EQ(receiver.deadline(), Stamp::max());
  }
}

TEST(IsoTp, EveryPduKeepsThePaceAndBlocksOfFlowControl) {
  EXPECT_TRUE(rc::check([] {
    const Bytes pdu = any_pdu(*rc::gen::inRange<std::size_t>(1, kIsoTpPduMax + 1));
    const int block_size = *rc::gen::inRange(0, 20);
    const int st_min_ms = *rc::gen::inRange(0, 128);
    Wire wire;
    wire.receiver =
        IsoTpReceiver({static_cast<std::uint8_t>(block_size), static_cast<std::uint8_t>(st_min_ms)},
                      {milliseconds(100), milliseconds(200)});
    RC_ASSERT(wire.sender.begin(pdu));
    wire.run();
    RC_ASSERT(wire.faults.empty());
    RC_ASSERT(wire.arrived == std::vector<Bytes>{pdu});
    // 6 bytes in the first frame, 7 in each after it; a flow control for the first and after each full block.
    const int rest = pdu.size() <= 7 ? 0 : (static_cast<int>(pdu.size()) - 6 + 6) / 7;
    const int flows = rest == 0 ? 0 : block_size == 0 ? 1 : 1 + (rest - 1) / block_size;
    RC_ASSERT(wire.frames == 1 + rest + flows);
    for (std::size_t i = 1; i < wire.consecutive.size(); ++i) {
      const bool new_block = block_size > 0 && i % static_cast<std::size_t>(block_size) == 0;
      RC_ASSERT(new_block || wire.consecutive[i] - wire.consecutive[i - 1] >= milliseconds(st_min_ms));
    }
  }));
}

TEST(IsoTp, AfterLossesNothingWrongArrivesAndTheNextPasses) {
  EXPECT_TRUE(rc::check([] {
    const Bytes pdu = any_pdu(*rc::gen::inRange<std::size_t>(8, kIsoTpPduMax + 1));
    const int one_in = *rc::gen::inRange(1, 20);
    std::vector<bool> losses(200);
    for (std::size_t i = 0; i < losses.size(); ++i) losses[i] = *rc::gen::inRange(0, one_in) == 0;
    Wire wire;
    wire.receiver = IsoTpReceiver({static_cast<std::uint8_t>(*rc::gen::inRange(0, 5)), 0});
    wire.lost = [&](int frame) { return losses[static_cast<std::size_t>(frame) % losses.size()]; };
    RC_ASSERT(wire.sender.begin(pdu));
    wire.run();
    RC_ASSERT(wire.sender.idle() && wire.receiver.deadline() == Stamp::max());
    for (const Bytes& got : wire.arrived) RC_ASSERT(got == pdu);
    RC_ASSERT(!wire.faults.empty() || wire.arrived.size() == 1);

    wire.lost = [](int) { return false; };
    wire.arrived.clear();
    const Bytes next = any_pdu(30);
    RC_ASSERT(wire.sender.begin(next));
    wire.run();
    RC_ASSERT(wire.arrived == std::vector<Bytes>{next});
  }));
}

TEST(IsoTp, NobodyListens) {
  Wire wire;
  wire.lost = [](int) { return true; };
  ASSERT_TRUE(wire.sender.begin(Bytes(20)));
  EXPECT_FALSE(wire.sender.begin(Bytes(20)));
  wire.run();
  EXPECT_EQ(wire.faults, std::vector{IsoTpFault::kNoFlow});
  EXPECT_EQ(wire.now - kStart, milliseconds(100));
}

TEST(IsoTp, ASenderThatFallsSilentIsGivenUp) {
  IsoTpReceiver receiver;
  (void)receiver.take(from_hex("10 14 00 00 00 00 00 00"), kStart);
  EXPECT_EQ(receiver.deadline(), kStart + milliseconds(100));
  EXPECT_EQ(receiver.expire(kStart + milliseconds(99)), IsoTpFault::kNone);
  EXPECT_EQ(receiver.expire(kStart + milliseconds(100)), IsoTpFault::kGap);
  EXPECT_EQ(receiver.expire(kStart + milliseconds(200)), IsoTpFault::kNone);
  EXPECT_EQ(receiver.take(from_hex("21 00 00 00 00 00 00 00"), kStart).fault, IsoTpFault::kUnexpected);
}

TEST(IsoTp, WrongSequenceEndsTheTransfer) {
  for (const char* second : {"22 00 00 00 00 00 00 00", "20 00 00 00 00 00 00 00"}) {
    IsoTpReceiver receiver;
    (void)receiver.take(from_hex("10 20 00 00 00 00 00 00"), kStart);
    EXPECT_EQ(receiver.take(from_hex(second), kStart).fault, IsoTpFault::kSequence);
    EXPECT_EQ(receiver.deadline(), Stamp::max());
  }
}

TEST(IsoTp, ImpossibleLengthsAreRefused) {
  for (const char* frame : {"00 01 02", "08 01 02 03 04 05 06 07", "03 01 02", "10 07 00 00 00 00 00 00",
                            "10 20 00 00 00 00 00", "10"}) {
    IsoTpReceiver receiver;
    const auto taken = receiver.take(from_hex(frame), kStart);
    EXPECT_EQ(taken.fault, IsoTpFault::kLength) << frame;
    EXPECT_FALSE(taken.reply.has_value());
    EXPECT_TRUE(taken.pdu.empty());
  }
  IsoTpReceiver receiver;
  EXPECT_EQ(receiver.take({}, kStart).fault, IsoTpFault::kLength);
  (void)receiver.take(from_hex("10 20 00 00 00 00 00 00"), kStart);
  EXPECT_EQ(receiver.take(from_hex("21 00 00"), kStart).fault, IsoTpFault::kLength);  // not the last: 7 bytes
}

TEST(IsoTp, TooLongAPduIsAnsweredWithOverflow) {
  // 257 bytes, and a length of 32 bits.
  for (const char* frame : {"11 01 00 00 00 00 00 00", "10 00 00 00 10 00 00 00"}) {
    IsoTpReceiver receiver;
    const auto taken = receiver.take(from_hex(frame), kStart);
    EXPECT_EQ(taken.fault, IsoTpFault::kTooLong);
    EXPECT_EQ(bytes_of(taken.reply), from_hex("32 00 00 cc cc cc cc cc"));
    EXPECT_EQ(receiver.deadline(), Stamp::max());
  }
  IsoTpSender sender;
  EXPECT_FALSE(sender.begin(Bytes(kIsoTpPduMax + 1)));
  EXPECT_FALSE(sender.begin({}));
}

TEST(IsoTp, AReceiverMayRefuse) {
  const std::vector<std::pair<const char*, IsoTpFault>> answers{{"32 00 00", IsoTpFault::kRefused},
                                                                {"31 00 00", IsoTpFault::kRefused},
                                                                {"33 00 00", IsoTpFault::kFlowStatus}};
  for (const auto& [answer, fault] : answers) {
    IsoTpSender sender;
    EXPECT_EQ(sender.take_flow(from_hex("30 00 00"), kStart), IsoTpFault::kUnexpected);
    ASSERT_TRUE(sender.begin(Bytes(20)));
    (void)sender.next(kStart);
    EXPECT_EQ(sender.take_flow(from_hex("30 00"), kStart), IsoTpFault::kLength);
    EXPECT_FALSE(sender.idle());
    EXPECT_EQ(sender.take_flow(from_hex(answer), kStart), fault) << answer;
    EXPECT_TRUE(sender.idle());
  }
}

TEST(IsoTp, AnotherStartInTheMiddleTakesTheOldOnesPlace) {
  IsoTpReceiver receiver;
  (void)receiver.take(from_hex("10 20 00 00 00 00 00 00"), kStart);
  const auto taken = receiver.take(from_hex("02 aa bb"), kStart);
  EXPECT_EQ(taken.fault, IsoTpFault::kUnexpected);
  EXPECT_EQ(to_bytes(taken.pdu), from_hex("aa bb"));
  EXPECT_EQ(receiver.deadline(), Stamp::max());
}

TEST(IsoTp, GapsOfTheStandardsTable) {
  const std::vector<std::pair<const char*, Duration>> gaps{
      {"30 00 00", Duration::zero()},  {"30 00 05", milliseconds(5)},   {"30 00 7f", milliseconds(127)},
      {"30 00 80", milliseconds(127)}, {"30 00 f1", microseconds(100)}, {"30 00 f9", microseconds(900)},
      {"30 00 fa", milliseconds(127)}};
  for (const auto& [flow, gap] : gaps) {
    IsoTpSender sender;
    ASSERT_TRUE(sender.begin(Bytes(30)));
    (void)sender.next(kStart);
    ASSERT_EQ(sender.take_flow(from_hex(flow), kStart), IsoTpFault::kNone);
    ASSERT_TRUE(sender.next(kStart).has_value());
    EXPECT_EQ(sender.due(), kStart + gap) << flow;
  }
}

TEST(IsoTp, AnAbortedTransferLeavesRoomForTheNext) {
  Wire wire;
  ASSERT_TRUE(wire.sender.begin(Bytes(100)));
  (void)wire.sender.next(kStart);
  wire.sender.abort();
  ASSERT_TRUE(wire.sender.begin(from_hex("01 02 03")));
  wire.run();
  EXPECT_EQ(wire.arrived, std::vector<Bytes>{from_hex("01 02 03")});
}

}  // namespace
}  // namespace topo::io
