// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The helper that runs when the daemon is gone, on true wires against the simulated robot's firmware.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <tuple>

#include "daemon/estop/stop_robot.hpp"
#include "drivers/io/make_connector.hpp"
#include "drivers/io/posix.hpp"
#include "drivers/pioneer/arcos_codec.hpp"
#include "tests/integration/room_harness.hpp"

namespace topo::daemon {
namespace {

using pioneer::Command;
using pioneer::encode;
using std::chrono::milliseconds;
using std::chrono::seconds;
using types::Duration;
using types::Stamp;

constexpr auto kBase = sim::DeviceId::kBase;

class EstopOnWire : public testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    std::string name = testing::TempDir() + "estop_sim_XXXXXX";
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
    harness_ = sim::start_in_room(GetParam() ? sim::tcp_robot() : sim::pty_robot(folder_), sim::Difficulty{});
    ASSERT_NE(harness_, nullptr);
  }
  void TearDown() override {
    harness_.reset();
    std::filesystem::remove_all(folder_);
  }

  [[nodiscard]] std::unique_ptr<io::Connector> connector() const {
    auto made = io::make_connector(text_of(harness_->address(0, kBase)));
    return made ? std::move(*made) : nullptr;
  }

  /// A host that opens a session, drives at 0.5 m/s and dies: its port is closed without a word.
  void drive_and_die() {
    auto opened = connector()->connect(seconds(2));
    ASSERT_TRUE(opened) << opened.error().message;
    io::ByteStream& stream = **opened;
    ASSERT_TRUE(stream.set_baud(9600));
    for (const auto& packet :
         {encode(Command::kPulse), encode(Command::kOpen), encode(Command::kClose), encode(Command::kOpen, 1),
          encode(Command::kEnable, 1), encode(Command::kSetV, 500), encode(Command::kVel, 500)}) {
      ASSERT_TRUE(stream.write(packet.bytes(), seconds(1)));
      listen(stream, milliseconds(100));
    }
    ASSERT_TRUE(until([&] { return speed_mps() > 0.4; }, seconds(6), &stream)) << speed_mps();
  }
  static void listen(io::ByteStream& stream, Duration duration) {
    std::array<std::byte, 512> ignored{};
    for (const Stamp end = io::monotonic_now() + duration; io::monotonic_now() < end;)
      std::ignore = stream.read(ignored, end - io::monotonic_now());
  }
  template <class Condition>
  bool until(const Condition& condition, Duration limit, io::ByteStream* stream = nullptr) {
    for (const Stamp end = io::monotonic_now() + limit; io::monotonic_now() < end && !condition();) {
      if (stream != nullptr) listen(*stream, milliseconds(10));
    }
    return condition();
  }
  double speed_mps() {
    const auto before = harness_->truth();
    sim::Truth after = before;
    while (after.sim_s < before.sim_s + 0.02) after = harness_->truth();
    return (after.path_m - before.path_m) / (after.sim_s - before.sim_s);
  }
  bool closed() {
    return harness_->with_rig([](sim::SimRig& rig) {
      const auto& base = rig.robot(0).base();
      return base.state() == sim::ArcosDevice::State::kWait && !base.motors_on();
    });
  }

  std::filesystem::path folder_;
  std::unique_ptr<sim::SimHarness> harness_;
};

TEST_P(EstopOnWire, StopsARobotThatDrivesOnAndClosesItsSession) {
  drive_and_die();
  const double before_m = harness_->truth().path_m;
  const auto port = connector();
  const Stamp begin = io::monotonic_now();
  const auto outcome = stop_robot(*port);
  const Duration took = io::monotonic_now() - begin;
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_EQ(*outcome, StopOutcome::kStands);
  EXPECT_LT(took, seconds(1));
  EXPECT_TRUE(until([&] { return closed(); }, seconds(2)));
  EXPECT_TRUE(until([&] { return speed_mps() == 0.0; }, seconds(2)));
  const double way_m = harness_->truth().path_m - before_m;
  RecordProperty("way_mm", static_cast<int>(way_m * 1e3));
  // At 0.5 m/s the firmware's own watchdog would have let it go on for a metre before it brakes.
  EXPECT_LT(way_m, 0.4);
}

TEST_P(EstopOnWire, MayBeRepeated) {
  drive_and_die();
  const auto port = connector();
  ASSERT_TRUE(stop_robot(*port));
  ASSERT_TRUE(until([&] { return speed_mps() == 0.0; }, seconds(2)));
  const double before_m = harness_->truth().path_m;
  for (int i = 0; i < 2; ++i) {
    const auto outcome = stop_robot(*port);
    ASSERT_TRUE(outcome) << outcome.error().message;
    EXPECT_EQ(*outcome, StopOutcome::kSilent);
  }
  EXPECT_TRUE(closed());
  EXPECT_EQ(harness_->truth().path_m, before_m);
}

INSTANTIATE_TEST_SUITE_P(Wires, EstopOnWire, testing::Bool(),
                         [](const auto& tcp) { return tcp.param ? "Tcp" : "Pty"; });

}  // namespace
}  // namespace topo::daemon
