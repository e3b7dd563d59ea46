// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// What only a bus can do to a connection: interfaces that are switched off or vanish, controllers that report
// errors, a queue that is full. Runs as root where there is a bus (tests/vm/can_test.py).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/can.h>
#include <linux/can/error.h>

#include <cstdlib>
#include <functional>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "daemon/app/doctor.hpp"
#include "daemon/estop/stop_robot.hpp"
#include "drivers/io/can_interface.hpp"
#include "drivers/pioneer/base_connector.hpp"
#include "drivers/pioneer/connection.hpp"
#include "tests/integration/can_bus.hpp"
#include "tests/integration/room_harness.hpp"

namespace topo::test {
namespace {

using pioneer::Connection;
using pioneer::Health;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;
using types::Duration;

constexpr auto kBase = sim::DeviceId::kBase;

void shell(const std::string& command) { ASSERT_EQ(std::system(command.c_str()), 0) << command; }

class CanWire : public testing::TestWithParam<CanPair> {
 protected:
  void SetUp() override {
    harness_ = sim::start_in_room(light_can_robot(GetParam().robot), sim::Difficulty::none());
    ASSERT_NE(harness_, nullptr);
    auto connector = pioneer::make_base_connector(address());
    ASSERT_TRUE(connector) << connector.error().message;
    session_ = std::make_unique<Connection>(pioneer::ConnectionConfig{}, std::move(*connector));
    ASSERT_TRUE(reach(Health::kReady)) << session_->message();
  }
  [[nodiscard]] std::string address() const { return "can:" + GetParam().driver + ":0"; }
  [[nodiscard]] const std::string& interface() const { return GetParam().driver; }

  bool run_until(const std::function<bool()>& done, Duration limit) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (std::chrono::steady_clock::now() < end && !done())
      std::ignore = session_->step(state_, milliseconds(20));
    return done();
  }
  bool reach(Health wanted, Duration limit = seconds(20)) {
    return run_until([&] { return session_->health() == wanted; }, limit);
  }
  bool lose(Duration limit = seconds(5)) {
    return run_until([&] { return session_->health() != Health::kReady; }, limit);
  }
  void drive(double v_mps, Duration duration) {
    const auto end = std::chrono::steady_clock::now() + duration;
    while (std::chrono::steady_clock::now() < end) {
      std::ignore = session_->command({.twist = {v_mps, 0.0}, .enable_motors = true, .estop = false});
      const auto period = std::chrono::steady_clock::now() + milliseconds(50);
      while (std::chrono::steady_clock::now() < period) std::ignore = session_->step(state_, milliseconds(5));
    }
  }
  /// What `topoctl doctor` says of the bus.
  [[nodiscard]] daemon::Check doctor() const {
    daemon::DoctorFacts facts;
    const auto known = io::query_can_interface(interface());
    EXPECT_TRUE(known);
    facts.can = daemon::DoctorFacts::Can{interface(), *known};
    for (const auto& check : daemon::examine(facts)) {
      if (check.name == "can") return check;
    }
    return {};
  }
  std::unique_ptr<sim::SimHarness> harness_;
  std::unique_ptr<Connection> session_;
  types::BaseState state_;
};

TEST_P(CanWire, AnInterfaceThatIsSwitchedOffIsNamedAndComesBack) {
  harness_->cut(0, kBase, 1.0);  // its interface is the same
  EXPECT_TRUE(doctor().ok) << doctor().found;
  shell("ip link set " + interface() + " down");
  ASSERT_TRUE(
      run_until([&] { return session_->message().find("switched off") != std::string::npos; }, seconds(5)))
      << session_->message();
  EXPECT_FALSE(doctor().ok);
  EXPECT_THAT(doctor().found, HasSubstr("switched off"));
  EXPECT_THAT(doctor().cure, HasSubstr("ip link set " + interface() + " up"));
  shell("ip link set " + interface() + " up");
  EXPECT_TRUE(reach(Health::kReady)) << session_->message();
  EXPECT_TRUE(doctor().ok) << doctor().found;
}

TEST_P(CanWire, BusOffIsToldAndSurvived) {
  CanBus bus(GetParam().driver);
  ASSERT_TRUE(bus.send(CAN_ERR_FLAG | CAN_ERR_BUSOFF, {0, 0, 0, 0, 0, 0, 0, 0}));
  ASSERT_TRUE(lose());
  EXPECT_THAT(session_->message(), HasSubstr("bus-off"));
  EXPECT_TRUE(reach(Health::kReady)) << session_->message();
}

TEST_P(CanWire, NobodyWhoAcknowledgesIsToldAndSurvived) {
  harness_->cut(0, kBase, 4.0);
  CanBus bus(GetParam().driver);
  EXPECT_TRUE(run_until(
      [&] {
        bus.send(CAN_ERR_FLAG | CAN_ERR_ACK, {0, 0, 0, 0, 0, 0, 0, 0});
        return session_->message().find("nobody acknowledges") != std::string::npos;
      },
      seconds(4)))
      << session_->message();
  EXPECT_TRUE(reach(Health::kReady)) << session_->message();
}

TEST_P(CanWire, HostileFramesAmongTheRobotsOwnAreSurvived) {
  CanBus bus(GetParam().robot);
  const auto before = session_->counters().status_packets;
  unsigned noise = 1;
  ASSERT_TRUE(run_until(
      [&] {
        for (int i = 0; i < 3; ++i) {
          std::vector<std::uint8_t> frame(noise % 9);
          for (auto& byte : frame)
            byte = static_cast<std::uint8_t>((noise = noise * 1103515245U + 12345U) >> 16U);
          noise = noise * 1103515245U + 12345U;
          bus.send(0x698, frame);
        }
        return session_->counters().status_packets > before + 10;
      },
      seconds(20)));
  EXPECT_EQ(session_->health(), Health::kReady) << session_->message();
}

TEST_P(CanWire, TheHelperThatStopsALeftRobotSpeaksCan) {
  drive(0.4, seconds(2));
  const double before_m = harness_->truth().path_m;
  auto port = pioneer::make_base_connector(address());
  ASSERT_TRUE(port);
  const auto outcome = daemon::stop_robot(**port);
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_NE(*outcome, daemon::StopOutcome::kMoves);
  const double stopped_m = harness_->truth().path_m;
  EXPECT_LT(stopped_m - before_m, 0.5);
  std::this_thread::sleep_for(seconds(1));  // nothing is left that could wake it up
  EXPECT_LT(harness_->truth().path_m - stopped_m, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Buses, CanWire, testing::ValuesIn(can_pairs()),
                         [](const auto& pair) { return pair.param.name(); });
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(CanWire);

/// A virtual interface can be unplugged.
TEST(CanInterfaceThatVanishes, IsNamedAndFoundAgainWhenItReturns) {
  if (can_pairs().empty()) GTEST_SKIP() << "no bus: set TOPOMETRIC_CAN";
  shell("ip link add vcan7 type vcan && ip link set vcan7 up");
  pioneer::Connection connection({}, std::move(*pioneer::make_base_connector("can:vcan7")));
  auto harness = sim::start_in_room(light_can_robot("vcan7"), sim::Difficulty::none());
  ASSERT_NE(harness, nullptr);
  types::BaseState state;
  const auto run_until = [&](const std::function<bool()>& done) {
    const auto end = std::chrono::steady_clock::now() + seconds(20);
    while (std::chrono::steady_clock::now() < end && !done())
      std::ignore = connection.step(state, milliseconds(20));
    return done();
  };
  ASSERT_TRUE(run_until([&] { return connection.health() == Health::kReady; })) << connection.message();
  harness->cut(0, kBase, 3.0);
  shell("ip link delete vcan7");
  ASSERT_TRUE(run_until([&] {
    return connection.message().find("there is no interface vcan7") != std::string::npos;
  })) << connection.message();
  shell("ip link add vcan7 type vcan && ip link set vcan7 up");
  EXPECT_TRUE(run_until([&] { return connection.health() == Health::kReady; })) << connection.message();
  connection.close(seconds(1));
  harness.reset();
  shell("ip link delete vcan7");
}

/// A controller with a bit rate, as an adapter has it.
TEST(CanController, TheDoctorKnowsTheBitRate) {
  if (can_controllers().empty()) GTEST_SKIP() << "no controller: set TOPOMETRIC_CAN_CONTROLLERS";
  for (const CanPair& pair : can_controllers()) {
    const auto& name = pair.driver;
    shell("ip link set " + name + " down && ip link set " + name +
          " up type can bitrate 125000 restart-ms 100");
    const auto wrong = io::complaint_about(*io::query_can_interface(name), name);
    ASSERT_TRUE(wrong);
    EXPECT_THAT(wrong->found, HasSubstr("runs at 125000 bit/s"));
    // The cure is a command that a person copies: it has to work.
    shell(wrong->cure);
    const auto cured = io::query_can_interface(name);
    EXPECT_FALSE(io::complaint_about(*cured, name));
    EXPECT_EQ(cured->bit_rate_bps, 500'000U);
    EXPECT_EQ(cured->restart_ms, 100U);
    EXPECT_EQ(cured->state, io::CanState::kActive);
    shell("ip link set " + name + " txqueuelen 10");
    const auto shorter = io::complaint_about(*io::query_can_interface(name), name);
    ASSERT_TRUE(shorter);
    shell(shorter->cure);
    EXPECT_FALSE(io::complaint_about(*io::query_can_interface(name), name));
  }
}

}  // namespace
}  // namespace topo::test
