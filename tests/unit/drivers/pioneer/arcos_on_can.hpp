// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "drivers/pioneer/arcos_can_stream.hpp"
#include "tests/mocks/scripted_can.hpp"
#include "tests/sim/devices/can_message.hpp"

namespace topo::pioneer {

using mocks::frame_bytes;
inline constexpr std::uint16_t kUnit = 3;
inline constexpr std::uint16_t kStopId = 0x68B, kOutId = 0x693, kInId = 0x69B, kBeatId = 0x6A3;
inline const std::string kFlow = frame_bytes("30 00 00 cc cc cc cc cc");
inline const std::string kEStopPacket = frame_bytes("fa fb 03 37 00 37");
inline const std::string kVelPacket = frame_bytes("fa fb 06 0b 3b fa 00 05 3b");
inline const std::string kStatusPacket = frame_bytes(
    "fa fb 28 33 fe 7f 05 00 00 fc c3 00 cd 00 7f 00 00 00 00 07 00 00 02 03 dc 05 04 83 13 00 00 00 ff 00 "
    "7f 00 00 "
    "10 00 00 00 55 85");

/// A stream on a bus whose time only waiting moves; at the far end the simulator's own segmentation.
class ArcosOnCan : public testing::Test {
 protected:
  mocks::ScriptedCan bus;
  std::unique_ptr<ArcosCanStream> stream =
      std::make_unique<ArcosCanStream>(std::make_unique<mocks::ScriptedCanPort>(bus), kUnit);
  sim::can::Assembler robot_in;
  std::vector<std::string> robot_heard;

  /// A robot that puts messages together and answers `delay` later.
  void robot_answers(types::Duration delay = std::chrono::microseconds(300)) {
    bus.on_sent = [this, delay](const mocks::ScriptedCan::Sent& sent) {
      if (sent.id != kOutId || sim::can::is_flow(sent.data)) return;
      auto step = robot_in.take(sent.data, sim_now());
      if (step.message) robot_heard.push_back(*step.message);
      if (step.answer) bus.arrive(kInId, *step.answer, delay);
    };
  }
  [[nodiscard]] sim::SimTime sim_now() const { return bus.now.time_since_epoch(); }

  types::Status write(const std::string& bytes) {
    const auto* first = reinterpret_cast<const std::byte*>(bytes.data());
    return stream->write({first, bytes.size()}, std::chrono::milliseconds(50));
  }
  types::Result<io::ReadResult> read(types::Duration timeout = std::chrono::milliseconds(20)) {
    auto got = stream->read(buffer, timeout);
    text.assign(reinterpret_cast<const char*>(buffer.data()), got ? got->bytes : 0);
    return got;
  }
  /// All that comes meanwhile.
  std::string read_ten_times() {
    std::string all;
    for (int i = 0; i < 10; ++i) {
      const auto got = read();
      EXPECT_TRUE(got);
      all += text;
    }
    return all;
  }
  /// The robot sends a packet frame by frame, `gap` apart.
  void robot_sends(const std::string& packet, types::Duration gap = std::chrono::microseconds(270)) {
    sim::can::Splitter splitter;
    splitter.start(packet, sim_now());
    bus.arrive(kInId, *splitter.next(sim_now()));
    splitter.on_flow(kFlow, sim_now());
    while (const auto frame = splitter.next(sim_now()))
      bus.arrive(kInId, *frame, gap += std::chrono::microseconds(270));
  }

  std::array<std::byte, 512> buffer{};
  std::string text;
};

}  // namespace topo::pioneer
