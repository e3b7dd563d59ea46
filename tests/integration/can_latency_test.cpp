// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// From the order to the wire: on CAN by the kernel's stamps, on a terminal until the other end has the bytes.
#include <fcntl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "drivers/io/can_socket.hpp"
#include "drivers/pioneer/arcos_codec.hpp"
#include "drivers/pioneer/base_connector.hpp"
#include "tests/integration/can_bus.hpp"

namespace topo::test {
namespace {

using pioneer::Command;
using std::chrono::milliseconds;

constexpr std::uint32_t kExact = 0x7FF, kStopId = 0x688, kToRobotId = 0x690, kFromRobotId = 0x698;
constexpr int kRounds = 500;
constexpr double kStopMean_us = 5e3;
// Of a single one: as late as a machine may wake us 1 time in 100 that is fit to measure on (on_time.py).
constexpr double kStopWorst_us = 20e3;

struct Figure {
  double mean_us = 0.0, worst_us = 0.0;
};

Figure tell(const char* what, const std::string& where, std::vector<double> late_s) {
  std::sort(late_s.begin(), late_s.end());
  const double mean_s =
      std::accumulate(late_s.begin(), late_s.end(), 0.0) / static_cast<double>(late_s.size());
  const Figure figure{1e6 * mean_s, 1e6 * late_s.back()};
  std::printf("[figure] %s, %s: mean %.0f us, p99 %.0f us, worst %.0f us (%zu)\n", where.c_str(), what,
              figure.mean_us, 1e6 * late_s[late_s.size() * 99 / 100], figure.worst_us, late_s.size());
  return figure;
}

/// A gateway that answers the first frame of every packet at once.
class QuickGateway {
 public:
  explicit QuickGateway(const std::string& interface)
      : bus_(interface, kToRobotId, kExact), thread_([this] { run(); }) {}
  ~QuickGateway() {
    stop_ = true;
    thread_.join();
  }
  QuickGateway(const QuickGateway&) = delete;
  QuickGateway& operator=(const QuickGateway&) = delete;

 private:
  void run() {
    while (!stop_) {
      const auto heard = bus_.hear(0.02);
      if (heard && !heard->data.empty() && heard->data[0] / 16 == 1) bus_.send(kFromRobotId, {0x30, 0, 0});
    }
  }
  CanBus bus_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

std::unique_ptr<io::ByteStream> open(const std::string& address) {
  auto stream = (*pioneer::make_base_connector(address))->connect(milliseconds(200));
  EXPECT_TRUE(stream) << stream.error().message;
  return stream ? std::move(*stream) : nullptr;
}

TEST(CommandToWire, OnCan) {
  if (can_pairs().empty()) GTEST_SKIP() << "no bus: set TOPOMETRIC_CAN";
  const auto setpoint = pioneer::encode(Command::kVel, 250);
  const auto e_stop = pioneer::encode(Command::kEStop);
  for (const CanPair& pair : can_pairs()) {
    const auto stream = open("can:" + pair.driver);
    ASSERT_NE(stream, nullptr);
    QuickGateway gateway(pair.robot);
    CanBus packets(pair.driver, kToRobotId, kExact), stops(pair.driver, kStopId, kExact);
    std::array<std::byte, 256> buffer{};
    std::vector<double> first_s, whole_s, stop_s;
    for (int round = 0; round < kRounds; ++round) {
      const double order_s = realtime_s();
      ASSERT_TRUE(stream->write(setpoint.bytes(), milliseconds(50)));
      while (!stream->ready()) ASSERT_TRUE(stream->read(buffer, milliseconds(200)));
      const auto first = packets.hear(0.2), last = packets.hear(0.2);
      ASSERT_TRUE(first && last) << "round " << round;
      first_s.push_back(first->realtime_s - order_s);
      whole_s.push_back(last->realtime_s - order_s);
      stops.forget();  // each goes out twice
      const double stop_order_s = realtime_s();
      ASSERT_TRUE(stream->write(e_stop.bytes(), milliseconds(50)));
      const auto stop = stops.hear(0.2);
      ASSERT_TRUE(stop);
      stop_s.push_back(stop->realtime_s - stop_order_s);
    }
    const Figure stop = tell("stop on the wire", pair.name(), stop_s);
    EXPECT_LT(stop.mean_us, kStopMean_us);
    EXPECT_LT(stop.worst_us, kStopWorst_us);
    tell("first frame of a setpoint on the wire", pair.name(), first_s);
    tell("last frame of a setpoint on the wire", pair.name(), whole_s);
  }
}

TEST(CommandToWire, OnATerminal) {
  if (can_pairs().empty()) GTEST_SKIP() << "only beside CAN";
  const sim::FileDescriptor master(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC));
  std::array<char, 64> name{};
  ASSERT_EQ(::grantpt(master.get()) | ::unlockpt(master.get()) |
                ::ptsname_r(master.get(), name.data(), name.size()),
            0);
  const auto stream = open("serial:" + std::string(name.data()));
  ASSERT_NE(stream, nullptr);
  const auto setpoint = pioneer::encode(Command::kVel, 250);
  std::vector<double> late_s;
  for (int round = 0; round < kRounds; ++round) {
    std::array<char, 64> arrived{};
    const double order_s = realtime_s();
    ASSERT_TRUE(stream->write(setpoint.bytes(), milliseconds(50)));
    ASSERT_EQ(::read(master.get(), arrived.data(), arrived.size()),
              static_cast<ssize_t>(setpoint.bytes().size()));
    late_s.push_back(realtime_s() - order_s);
  }
  tell("setpoint at the other end", "terminal", late_s);
}

/// An emulated bus takes no time. This one takes that of 500 kbit/s: a frame counts 16 bytes to the kernel,
/// which is 128 bits, between what it has with the least and the most stuffing; and its queue has the bands
/// of a CAN interface.
class SlowBus {
 public:
  explicit SlowBus(std::string interface) : interface_(std::move(interface)) {
    run("add dev " + interface_ + " root handle 1: tbf rate 500kbit burst 160 limit 4096");
    run("add dev " + interface_ + " parent 1:1 handle 2: prio");
  }
  ~SlowBus() { run("del dev " + interface_ + " root"); }
  SlowBus(const SlowBus&) = delete;
  SlowBus& operator=(const SlowBus&) = delete;

 private:
  static void run(const std::string& words) {
    EXPECT_EQ(std::system(("tc qdisc " + words).c_str()), 0) << words;
  }
  std::string interface_;
};

/// Somebody else keeps the interface's queue full with frames of no importance. From the order to the wire,
/// for the first of the frames that `packet` becomes; a stop becomes two.
std::vector<double> through_a_crowd(const CanPair& pair, const pioneer::CommandPacket& packet,
                                    std::uint32_t id, std::size_t copies) {
  constexpr std::uint32_t kNobodys = 0x7FE;
  constexpr std::size_t kFloods = 50;
  constexpr int kPatience = 300;  // about 0.6 s; a queue that is full takes 40 ms
  const auto stream = open("can:" + pair.driver);
  CanBus listener(pair.driver, id, kExact), crowd(pair.driver, id, kExact);
  std::vector<double> late_s;
  while (stream != nullptr && late_s.size() < kFloods) {
    for (int i = 0; i < 1000 && crowd.send(kNobodys, {1, 2, 3, 4, 5, 6, 7, 8});) ++i;
    const double order_s = realtime_s();
    EXPECT_TRUE(stream->write(packet.bytes(), milliseconds(50)));
    std::array<std::byte, 16> none{};
    std::vector<CanBus::Heard> heard;
    for (int i = 0; i < kPatience && heard.size() < copies; ++i) {
      EXPECT_TRUE(stream->read(none, milliseconds(1)));  // tries again where there was no room at all
      while (auto frame = listener.hear(0.001)) heard.push_back(std::move(*frame));
    }
    if (heard.size() != copies) return {};
    late_s.push_back(heard.front().realtime_s - order_s);
  }
  std::sort(late_s.begin(), late_s.end());
  return late_s;
}

TEST(CommandToWire, AStopOvertakesAFullQueue) {
  if (can_controllers().empty()) GTEST_SKIP() << "no controller: set TOPOMETRIC_CAN_CONTROLLERS";
  for (const CanPair& pair : can_controllers()) {
    const SlowBus slow(pair.driver);
    const auto stop_s = through_a_crowd(pair, pioneer::encode(Command::kEStop), kStopId, 2);
    const auto other_s = through_a_crowd(pair, pioneer::encode(Command::kPulse), kToRobotId, 1);
    ASSERT_FALSE(stop_s.empty() || other_s.empty());
    EXPECT_LT(tell("stop on the wire past a full queue", pair.name(), stop_s).worst_us, kStopWorst_us);
    tell("another packet on the wire behind a full queue", pair.name(), other_s);
    EXPECT_LE(stop_s[stop_s.size() / 2], 0.005);
    EXPECT_LT(5.0 * stop_s[stop_s.size() / 2], other_s[other_s.size() / 2]);  // else nothing was overtaken
  }
}

TEST(CanSocket, CountsWhatTheKernelHadToDrop) {
  constexpr int kFlood = 5000;
  constexpr std::array<std::uint16_t, 1> kIds{kFromRobotId};
  if (can_pairs().empty()) GTEST_SKIP() << "no bus: set TOPOMETRIC_CAN";
  for (const CanPair& pair : can_pairs()) {
    auto port = io::CanSocket::open(pair.driver, kIds, pair.name());
    ASSERT_TRUE(port) << port.error().message;
    CanBus crowd(pair.robot, kFromRobotId, kExact);
    for (int i = 0; i < kFlood; ++i) ASSERT_TRUE(crowd.send(kFromRobotId, {1, 2, 3, 4}));
    // The count comes with the frames that are queued after the loss.
    const auto fetch = [&] {
      int frames = 0;
      for (auto event = (*port)->receive(milliseconds(20));
           event && std::holds_alternative<io::CanFrame>(*event); event = (*port)->receive(milliseconds(20)))
        ++frames;
      return frames;
    };
    const int fetched = fetch();
    EXPECT_LT(fetched, kFlood);
    ASSERT_TRUE(crowd.send(kFromRobotId, {5}));
    EXPECT_EQ(fetch(), 1);
    EXPECT_EQ((*port)->dropped(), static_cast<std::uint64_t>(kFlood - fetched));
  }
}

}  // namespace
}  // namespace topo::test
