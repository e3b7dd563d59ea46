// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The Pioneer connection on true wires (TCP, pseudo terminal, CAN where there is a bus) against the simulated
// robot's firmware.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include "drivers/pioneer/base_connector.hpp"
#include "drivers/pioneer/connection.hpp"
#include "tests/integration/can_bus.hpp"
#include "tests/integration/room_harness.hpp"

namespace topo::pioneer {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using types::BaseCommand;
using types::Duration;
using types::Stamp;

/// A stream whose host can die: from then on nothing that is written leaves.
class MortalStream final : public io::ByteStream {
 public:
  MortalStream(std::unique_ptr<io::ByteStream> inner, const bool& dead)
      : inner_(std::move(inner)), dead_(dead) {}
  types::Result<io::ReadResult> read(std::span<std::byte> buffer, Duration timeout) override {
    return inner_->read(buffer, timeout);
  }
  types::Status write(std::span<const std::byte> bytes, Duration timeout) override {
    if (dead_) return {};
    return inner_->write(bytes, timeout);
  }
  [[nodiscard]] bool ready() const override { return inner_->ready(); }
  [[nodiscard]] io::BusFaults faults() const override { return inner_->faults(); }
  types::Status set_baud(int baud) override { return inner_->set_baud(baud); }
  [[nodiscard]] bool has_baud() const override { return inner_->has_baud(); }
  [[nodiscard]] Stamp now() const override { return inner_->now(); }

 private:
  std::unique_ptr<io::ByteStream> inner_;
  const bool& dead_;
};

class MortalConnector final : public io::Connector {
 public:
  MortalConnector(std::unique_ptr<io::Connector> inner, const bool& dead)
      : inner_(std::move(inner)), dead_(dead) {}
  types::Result<std::unique_ptr<io::ByteStream>> connect(Duration timeout) override {
    auto stream = inner_->connect(timeout);
    if (!stream) return stream;
    return std::unique_ptr<io::ByteStream>(std::make_unique<MortalStream>(std::move(*stream), dead_));
  }
  [[nodiscard]] std::string_view name() const override { return inner_->name(); }

 private:
  std::unique_ptr<io::Connector> inner_;
  const bool& dead_;
};

enum class Kind { kTcp, kPty, kCan };
struct Wire {
  Kind kind;
  test::CanPair can{};  ///< when it is CAN
};

std::vector<Wire> wires() {
  std::vector<Wire> all{{Kind::kTcp}, {Kind::kPty}};
  for (const auto& pair : test::can_pairs()) all.push_back({Kind::kCan, pair});
  return all;
}
std::vector<Wire> wires(Kind kind) {
  std::vector<Wire> all = wires();
  std::erase_if(all, [kind](const Wire& wire) { return wire.kind != kind; });
  return all;
}
std::string name_of(const Wire& wire) {
  if (wire.kind == Kind::kCan) return "Can_" + wire.can.name();
  return wire.kind == Kind::kTcp ? "Tcp" : "Pty";
}

class PioneerOnWire : public testing::TestWithParam<Wire> {
 protected:
  static constexpr auto kBase = sim::DeviceId::kBase;

  void TearDown() override {
    dead_ = true;  // a connection that is still there need not stop a robot that goes away with it
    session_.reset();
    harness_.reset();
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }

  void start(int watchdog_ms = 2000) {
    sim::RobotConfig robot = make_robot();
    robot.watchdog_ms = watchdog_ms;
    harness_ = sim::start_in_room(std::move(robot), sim::Difficulty::none());
    ASSERT_NE(harness_, nullptr);
    open_session();
  }
  sim::RobotConfig make_robot() {
    switch (GetParam().kind) {
      case Kind::kCan:
        return test::light_can_robot(GetParam().can.robot);
      case Kind::kPty:
        return sim::pty_robot(make_folder());
      default:
        return sim::tcp_robot();
    }
  }
  /// As the driver's configuration would have it.
  [[nodiscard]] std::string address() const {
    if (GetParam().kind == Kind::kCan) return "can:" + GetParam().can.driver + ":0";
    return text_of(harness_->address(0, kBase));
  }
  std::filesystem::path make_folder() {
    folder_ = testing::TempDir() + "pioneer_sim_XXXXXX";
    std::string name = folder_.string();
    folder_ = ::mkdtemp(name.data());
    return folder_;
  }
  void open_session() {
    auto connector = make_base_connector(address());
    ASSERT_TRUE(connector) << connector.error().message;
    dead_ = false;
    session_ = std::make_unique<Connection>(ConnectionConfig{},
                                            std::make_unique<MortalConnector>(std::move(*connector), dead_));
  }
  /// The process is gone: no E_STOP, no CLOSE.
  void kill_host() {
    dead_ = true;
    session_.reset();
  }

  static Stamp now() {
    return Stamp{std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now().time_since_epoch())};
  }
  bool run_until(const std::function<bool()>& done, Duration limit) {
    for (const Stamp end = now() + limit; now() < end && !done();)
      std::ignore = session_->step(state_, milliseconds(20));
    return done();
  }
  bool reach(Health wanted, Duration limit = seconds(15)) {
    return run_until([&] { return session_->health() == wanted; }, limit);
  }
  void drive(double v_mps, double omega_radps, Duration duration) {
    for (const Stamp end = now() + duration; now() < end;) {
      std::ignore = session_->command({.twist = {v_mps, omega_radps}, .enable_motors = true, .estop = false});
      const Stamp period = now() + milliseconds(50);
      while (now() < period) std::ignore = session_->step(state_, period - now());
    }
  }
  double path_m() { return harness_->truth().path_m; }

  std::filesystem::path folder_;
  std::unique_ptr<sim::SimHarness> harness_;
  bool dead_ = false;
  std::unique_ptr<Connection> session_;
  types::BaseState state_;
};

TEST_P(PioneerOnWire, DrivesAndClosesInAnOrderlyWay) {
  start();
  ASSERT_TRUE(reach(Health::kReady)) << session_->message();
  EXPECT_EQ(session_->info()->subclass, "p3dx-sh");
  drive(0.3, 0.0, seconds(2));
  EXPECT_GT(path_m(), 0.25);
  EXPECT_TRUE(state_.motors_enabled);
  EXPECT_NEAR(state_.odometry.T_odom_base.x_m(), path_m(), 0.12);  // the status is up to 160 ms old
  EXPECT_NEAR(state_.odometry.twist.v_mps, 0.3, 0.02);
  EXPECT_GT(state_.sonar[0].range_m + state_.sonar[3].range_m, 1.0F);
  session_->close(seconds(2));
  const auto device = harness_->with_rig([](sim::SimRig& rig) {
    return std::pair(rig.robot(0).base().state(), rig.robot(0).base().motors_on());
  });
  EXPECT_TRUE(run_until(
      [&] {
        return harness_->with_rig([](sim::SimRig& rig) {
          return rig.robot(0).base().state() == sim::ArcosDevice::State::kWait &&
                 !rig.robot(0).base().motors_on();
        });
      },
      seconds(2)))
      << "state " << static_cast<int>(device.first) << ", motors " << device.second;
  EXPECT_EQ(session_->counters().bad_packets, 0U);
}

TEST_P(PioneerOnWire, ARobotWhoseHostDiedStandsWhenTheNextOneConnects) {
  start();
  ASSERT_TRUE(reach(Health::kReady)) << session_->message();
  drive(0.3, 0.0, seconds(2));
  kill_host();
  // The firmware's watchdog stops it and keeps the setpoint.
  ASSERT_TRUE([&] {
    for (const Stamp end = now() + seconds(8); now() < end;) {
      const bool stands = harness_->with_rig([](sim::SimRig& rig) {
        return rig.robot(0).base().watchdog_holds(rig.now()) && rig.robot(0).base().motors_on();
      });
      if (stands) return true;
    }
    return false;
  }());
  const double at_rest_m = [&] {
    double last = -1.0, path = path_m();
    for (const Stamp end = now() + seconds(5); now() < end && path != last;
         last = std::exchange(path, path_m()))
      std::ignore = harness_->truth();
    return path;
  }();
  open_session();
  ASSERT_TRUE(reach(Health::kReady)) << session_->message();
  EXPECT_LT(path_m() - at_rest_m, 0.35);  // what was left of the braking; 0.3 m/s would go on for metres
  const double connected_m = path_m();
  EXPECT_FALSE(run_until([] { return false; }, seconds(1)));
  EXPECT_LT(path_m() - connected_m, 0.002);
  drive(0.2, 0.0, seconds(1));
  EXPECT_GT(path_m() - connected_m, 0.05);
}

TEST_P(PioneerOnWire, ComesBackAfterACutLinkSilenceAndReset) {
  start();
  ASSERT_TRUE(reach(Health::kReady)) << session_->message();
  harness_->silence(0, kBase, 1.5);
  EXPECT_TRUE(reach(Health::kSilent));
  ASSERT_TRUE(reach(Health::kReady)) << session_->message();
  harness_->reset(0, kBase);
  EXPECT_TRUE(reach(Health::kReset));
  ASSERT_TRUE(reach(Health::kReady)) << session_->message();
  harness_->cut(0, kBase, 1.0);
  EXPECT_TRUE(run_until([&] { return session_->health() != Health::kReady; }, seconds(5)));
  ASSERT_TRUE(reach(Health::kReady)) << session_->message();
  EXPECT_EQ(session_->counters().reconnects, 3U);
}

TEST_P(PioneerOnWire, SeesStopButtonAndBumpers) {
  start();
  ASSERT_TRUE(reach(Health::kReady)) << session_->message();
  harness_->bumper(0, 0x02, 0x01, 5.0);
  EXPECT_TRUE(run_until([&] { return state_.bumpers_front == 2 && state_.bumpers_rear == 1; }, seconds(2)));
  harness_->stop_button(0, true);
  EXPECT_TRUE(run_until([&] { return state_.stop_button; }, seconds(2)));
}

TEST_P(PioneerOnWire, SurvivesGarbageAndLostBytes) {
  start();
  ASSERT_TRUE(reach(Health::kReady)) << session_->message();
  harness_->garbage(0, kBase, 500);
  harness_->drop(0, kBase, 0.002);
  const auto before = session_->counters().status_packets;
  EXPECT_TRUE(run_until([&] { return session_->counters().status_packets > before + 25; }, seconds(10)));
  EXPECT_EQ(session_->health(), Health::kReady) << session_->message();
}

TEST_P(PioneerOnWire, StopsAtOnceAtWhateverMomentItIsTold) {
  start();
  ASSERT_TRUE(reach(Health::kReady)) << session_->message();
  for (int round = 0; round < 5; ++round) {
    drive(0.3, 0.3, milliseconds(600 + 7 * round));
    const auto e_stops = [&] {
      return harness_->with_rig([](sim::SimRig& rig) { return rig.robot(0).base().e_stops(); });
    };
    const auto before = e_stops();
    const double path_before_m = path_m();
    std::ignore = session_->command({.twist = {}, .enable_motors = true, .estop = true});
    EXPECT_TRUE(run_until([&] { return e_stops() > before; }, milliseconds(500)));
    EXPECT_TRUE(run_until([&] { return state_.odometry.twist.v_mps == 0.0; }, seconds(3)));
    EXPECT_LT(path_m() - path_before_m, 0.25);
  }
}

/// Where a packet has a length.
class PioneerOnCan : public PioneerOnWire {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(PioneerOnCan);

/// Nobody answers the packet under way with flow control, so it blocks the bus's one transfer for 100 ms.
TEST_P(PioneerOnCan, AStopNeverWaitsForATransfer) {
  constexpr std::uint32_t kStopId = 0x688, kExact = 0x7FF;
  start();
  ASSERT_TRUE(reach(Health::kReady)) << session_->message();
  test::CanBus bus(GetParam().can.driver, kStopId, kExact);
  ASSERT_TRUE(bus.valid());
  double worst_s = 0.0;
  for (int round = 0; round < 20; ++round) {
    // Two packets later the robot is back from the round before.
    const auto heard = session_->counters().status_packets;
    ASSERT_TRUE(run_until([&] { return session_->counters().status_packets > heard + 1; }, seconds(15)));
    drive(0.2, 0.0, milliseconds(100));
    harness_->cut(0, kBase, 0.15);
    drive(0.3, 0.1, milliseconds(20));  // one turn of 50 ms: VEL is under way, RVEL waits behind it
    bus.forget();
    const auto interrupted = session_->counters().bus[io::BusFault::kInterrupted];
    const double order_s = test::realtime_s();
    std::ignore = session_->command({.twist = {}, .enable_motors = true, .estop = true});
    std::ignore = session_->step(state_, milliseconds(20));
    const auto stop = bus.hear(0.5);
    ASSERT_TRUE(stop);
    EXPECT_EQ(stop->data, std::vector<std::uint8_t>{0x37});
    // Else nothing was under way that it could have waited for.
    EXPECT_EQ(session_->counters().bus[io::BusFault::kInterrupted], interrupted + 1) << "round " << round;
    worst_s = std::max(worst_s, stop->realtime_s - order_s);
  }
  RecordProperty("worst_us", static_cast<int>(worst_s * 1e6));
  EXPECT_LE(worst_s, 0.005);
}

TEST_P(PioneerOnWire, WithoutAWatchdogItDoesNotDrive) {
  start(0);
  ASSERT_TRUE(reach(Health::kUnsafe)) << session_->message();
  drive(0.3, 0.0, seconds(1));
  EXPECT_EQ(path_m(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Wires, PioneerOnCan, testing::ValuesIn(wires(Kind::kCan)),
                         [](const auto& wire) { return name_of(wire.param); });
INSTANTIATE_TEST_SUITE_P(Wires, PioneerOnWire, testing::ValuesIn(wires()),
                         [](const auto& wire) { return name_of(wire.param); });

}  // namespace
}  // namespace topo::pioneer
