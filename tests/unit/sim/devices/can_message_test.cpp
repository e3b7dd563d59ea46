// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The simulator's segmentation against the vectors of the protocol, and against the driver's.
#include "tests/sim/devices/can_message.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "drivers/io/iso_tp.hpp"
#include "tests/mocks/scripted_can.hpp"

namespace topo::sim::can {
namespace {

using mocks::frame_bytes;
using std::chrono::milliseconds;

constexpr SimTime kNow = milliseconds{1000};

io::CanData to_driver(const std::string& frame) {
  io::CanData data;
  data.size = static_cast<std::uint8_t>(frame.size());
  std::transform(frame.begin(), frame.end(), data.bytes.begin(),
                 [](char c) { return static_cast<std::byte>(c); });
  return data;
}
std::string text_of(std::span<const std::byte> bytes) {
  std::string text;
  for (const std::byte byte : bytes) text.push_back(static_cast<char>(byte));
  return text;
}
std::vector<std::byte> to_bytes(const std::string& text) {
  std::vector<std::byte> bytes;
  for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
  return bytes;
}
types::Stamp stamp_of(SimTime now) { return types::Stamp{now}; }

// PROTOCOLS section 16.
TEST(CanMessage, CutsAsTheVectorsSay) {
  Splitter splitter;
  splitter.start(frame_bytes("fa fb 03 37 00 37"), kNow);
  EXPECT_EQ(splitter.next(kNow), frame_bytes("06 fa fb 03 37 00 37 cc"));
  EXPECT_FALSE(splitter.busy());
  splitter.start(frame_bytes("fa fb 06 0b 3b fa 00 05 3b"), kNow);
  EXPECT_EQ(splitter.next(kNow), frame_bytes("10 09 fa fb 06 0b 3b fa"));
  EXPECT_FALSE(splitter.next(kNow));
  splitter.on_flow(frame_bytes("30 00 00 cc cc cc cc cc"), kNow);
  EXPECT_EQ(splitter.next(kNow), frame_bytes("21 00 05 3b cc cc cc cc"));
  EXPECT_FALSE(splitter.busy());
}

TEST(CanMessage, PutsTheVectorsTogether) {
  Assembler assembler;
  auto step = assembler.take(frame_bytes("10 2b fa fb 28 33 fe 7f"), kNow);
  EXPECT_EQ(step.answer, frame_bytes("30 00 00 cc cc cc cc cc"));
  for (const char* frame : {"21 05 00 00 fc c3 00 cd", "22 00 7f 00 00 00 00 07", "23 00 00 02 03 dc 05 04",
                            "24 83 13 00 00 00 ff 00", "25 7f 00 00 10 00 00 00"})
    EXPECT_FALSE(assembler.take(frame_bytes(frame), kNow).message);
  step = assembler.take(frame_bytes("26 55 85"), kNow);  // not padded
  ASSERT_TRUE(step.message);
  EXPECT_EQ(step.message->size(), 43U);
  EXPECT_EQ(assembler.broken(), 0U);
}

TEST(CanMessage, GivesUpWhenNobodyAnswersAndGoesOn) {
  Splitter splitter;
  splitter.start(std::string(50, 'x'), kNow);
  ASSERT_TRUE(splitter.next(kNow));
  splitter.tick(kNow + milliseconds{99});
  EXPECT_TRUE(splitter.busy());
  splitter.tick(kNow + milliseconds{100});
  EXPECT_FALSE(splitter.busy());
  EXPECT_EQ(splitter.given_up(), 1U);
  splitter.start("abc", kNow);
  EXPECT_EQ(splitter.next(kNow), frame_bytes("03 61 62 63 cc cc cc cc"));
}

/// Both ways, every length, with a tenth of the frames lost: a message arrives whole or not at all.
TEST(CanMessage, UnderstandsTheDriverAndIsUnderstood) {
  std::mt19937 random(7);
  for (const bool lossy : {false, true}) {
    for (std::size_t size = 1; size <= 207; ++size) {
      const auto lost = [&] { return lossy && random() % 10 == 0; };
      std::string message(size, '\0');
      for (char& c : message) c = static_cast<char>(random());

      io::IsoTpReceiver driver_in;
      Splitter splitter;
      std::vector<std::string> heard;
      splitter.start(message, kNow);
      while (const auto frame = splitter.next(kNow)) {
        if (lost()) continue;
        const auto taken = driver_in.take(to_driver(*frame).view(), stamp_of(kNow));
        if (!taken.pdu.empty()) heard.push_back(text_of(taken.pdu));
        if (taken.reply && !lost()) splitter.on_flow(text_of(taken.reply->view()), kNow);
      }
      ASSERT_TRUE((lossy && heard.empty()) || heard == std::vector{message});

      io::IsoTpSender driver_out;
      Assembler assembler;
      std::vector<std::string> understood;
      ASSERT_TRUE(driver_out.begin(to_bytes(message)));
      while (const auto frame = driver_out.next(stamp_of(kNow))) {
        if (lost()) continue;
        const auto step = assembler.take(text_of(frame->view()), kNow);
        if (step.message) understood.push_back(*step.message);
        if (step.answer && !lost()) driver_out.take_flow(to_driver(*step.answer).view(), stamp_of(kNow));
      }
      ASSERT_TRUE((lossy && understood.empty()) || understood == std::vector{message});
    }
  }
}

}  // namespace
}  // namespace topo::sim::can
