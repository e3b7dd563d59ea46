// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The Hokuyo connection against the simulator's sensors, whose codec is independent of the driver's, over
// true TCP and true terminals.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

#include "core/types/se2.hpp"
#include "drivers/hokuyo/connection.hpp"
#include "drivers/io/make_connector.hpp"
#include "drivers/io/posix.hpp"
#include "tests/integration/room_harness.hpp"

namespace topo::hokuyo {
namespace {

using namespace std::chrono_literals;
using sim::DeviceId;
using sim::ScipModel;
using testing::HasSubstr;

class HokuyoSim : public testing::Test {
 protected:
  void start(sim::RobotConfig robot) {
    simulator = sim::start_in_room(std::move(robot), sim::Difficulty::none());
    ASSERT_NE(simulator, nullptr);
  }

  void open(DeviceId device, ConnectionConfig config = {}) {
    config.name = "front";
    auto connector = io::make_connector(text_of(simulator->address(0, device)));
    ASSERT_TRUE(connector) << connector.error().message;
    connection = std::make_unique<Connection>(std::move(config), std::move(*connector));
  }

  void start_tcp(ScipModel model = ScipModel::kUtm30LxEw, ConnectionConfig config = {}) {
    sim::RobotConfig robot = sim::tcp_robot();
    robot.front = model;
    start(std::move(robot));
    open(DeviceId::kFront, std::move(config));
  }

  void start_pty(ScipModel model) {
    folder = std::filesystem::path(testing::TempDir()) /
             ("topo_hokuyo_" + std::to_string(io::monotonic_now().time_since_epoch().count()));
    std::filesystem::create_directories(folder);
    sim::RobotConfig robot = sim::pty_robot(folder);
    robot.front = model;
    start(std::move(robot));
    open(DeviceId::kFront);
  }

  void TearDown() override {
    connection.reset();
    simulator.reset();
    if (!folder.empty()) std::filesystem::remove_all(folder);
  }

  template <class Done>
  bool run(Done done, types::Duration limit = 20s) {
    const types::Stamp until = io::monotonic_now() + limit;
    while (io::monotonic_now() < until) {
      if (connection->step(*scan, 10ms) == StepOutcome::kScan) {
        ++scans;
        check_scan();
      }
      if (done()) return true;
    }
    return false;
  }
  bool run_scans(int count, types::Duration limit = 20s) {
    const int target = scans + count;
    return run([&] { return scans >= target; }, limit);
  }
  bool run_health(Health health) {
    return run([&] { return connection->health() == health; });
  }

  /// Whatever happens on the wire: what is given as a distance lies in the room.
  void check_scan() const {
    for (const float range_m : scan->ranges()) {
      if (types::is_hit(range_m)) {
        ASSERT_LT(range_m, 10.0F);
        ASSERT_GT(range_m, 0.02F);
      }
    }
  }

  [[nodiscard]] double range_at_deg(double degrees) const {
    const double rad = degrees * types::kDegree_rad;
    const double beam = (rad - static_cast<double>(scan->geometry.angle_min_rad)) /
                        static_cast<double>(scan->geometry.angle_increment_rad);
    return static_cast<double>(scan->range_m[static_cast<std::size_t>(std::lround(beam))]);
  }

  std::filesystem::path folder;
  std::unique_ptr<sim::SimHarness> simulator;
  std::unique_ptr<Connection> connection;
  std::unique_ptr<types::Scan> scan = std::make_unique<types::Scan>();
  int scans = 0;
};

TEST_F(HokuyoSim, StreamsOverTcpAndSeesTheRoom) {
  start_tcp();
  ASSERT_TRUE(run_scans(40)) << connection->message();
  EXPECT_EQ(connection->health(), Health::kStreaming);
  EXPECT_EQ(scan->beams, 1081);
  EXPECT_NEAR(range_at_deg(90) + range_at_deg(-90), 6.0, 0.01);
  EXPECT_NEAR(range_at_deg(90), range_at_deg(-90), 0.01);
  EXPECT_GT(range_at_deg(0), 3.0);
  EXPECT_LT(range_at_deg(0), 4.2);
  EXPECT_EQ(connection->counters().checksum_errors, 0U);
}

TEST_F(HokuyoSim, StampsAgreeWithTheSimulatorsTime) {
  start_tcp();
  ASSERT_TRUE(run_scans(80)) << connection->message();
  // Step 0 of every sweep passes at a whole multiple of the period since the simulation's start, plus a
  // constant which the first scans give away; the stamp must also lie a sweep before the arrival.
  double worst_ms = 0.0;
  for (int i = 0; i < 40; ++i) {
    ASSERT_TRUE(run_scans(1));
    const double latency_ms = types::to_seconds(scan->arrival - scan->first_beam) * 1e3;
    EXPECT_GT(latency_ms, 17.0);
    const double epoch_s = simulator->with_rig([](sim::SimRig& rig) { return rig.epoch_s(); });
    const double phase = (types::to_seconds(scan->first_beam) - epoch_s) / 0.025;
    worst_ms = std::max(worst_ms, std::abs(phase - std::round(phase)) * 25.0);
  }
  RecordProperty("worst_ms", std::to_string(worst_ms));
  EXPECT_LT(worst_ms, 8.0);
}

TEST_F(HokuyoSim, StreamsIntensityFromAUst) {
  start_tcp(ScipModel::kUst20Lx, {.intensity = true});
  ASSERT_TRUE(run_scans(10)) << connection->message();
  EXPECT_TRUE(scan->has_intensity);
  EXPECT_NEAR(range_at_deg(90) + range_at_deg(-90), 6.0, 0.01);
}

TEST_F(HokuyoSim, StreamsFromAUtmOnATerminal) {
  start_pty(ScipModel::kUtm30Lx);
  ASSERT_TRUE(run_scans(20)) << connection->message();
  EXPECT_NEAR(range_at_deg(90) + range_at_deg(-90), 6.0, 0.01);
  EXPECT_EQ(scan->beams, 1081);
}

TEST_F(HokuyoSim, SwitchesAUrgOnATerminalFromScip1) {
  start_pty(ScipModel::kUrg04Lx);
  ASSERT_TRUE(run_scans(10)) << connection->message();
  EXPECT_EQ(scan->beams, 682);
  EXPECT_NEAR(range_at_deg(90) + range_at_deg(-90), 6.0, 0.02);
}

TEST_F(HokuyoSim, TheTwoSensorsAreToldApart) {
  start_tcp();
  ASSERT_TRUE(run_scans(1)) << connection->message();
  const std::string front = connection->info()->serial_number;
  connection->close(500ms);
  open(DeviceId::kCoronal, {.serial_number = front});
  ASSERT_TRUE(run_health(Health::kWrongDevice));
  EXPECT_THAT(connection->message(), HasSubstr(front));
}

TEST_F(HokuyoSim, TheBaseIsNoLaser) {
  start_tcp();
  open(DeviceId::kBase);
  ASSERT_TRUE(run([&] {
    return connection->health() == Health::kWrongDevice || connection->health() == Health::kSilent;
  }));
  EXPECT_THAT(connection->message(), HasSubstr("expected a Hokuyo sensor"));
}

TEST_F(HokuyoSim, GarbageCostsScansAndNothingElse) {
  start_tcp();
  ASSERT_TRUE(run_scans(20)) << connection->message();
  for (int i = 0; i < 5; ++i) {
    simulator->garbage(0, DeviceId::kFront, 300);
    ASSERT_TRUE(run_scans(10)) << connection->message();
  }
  EXPECT_GT(connection->counters().checksum_errors, 0U);
  EXPECT_EQ(connection->counters().reconnects, 0U);
}

TEST_F(HokuyoSim, LostBytesCostScansAndNothingElse) {
  start_tcp();
  ASSERT_TRUE(run_scans(20)) << connection->message();
  simulator->drop(0, DeviceId::kFront, 0.0002);
  ASSERT_TRUE(run_scans(40)) << connection->message();
  simulator->drop(0, DeviceId::kFront, 0.0);
  ASSERT_TRUE(run_scans(20)) << connection->message();
  EXPECT_GT(connection->counters().lost_scans, 0U);
}

TEST_F(HokuyoSim, ACutLinkIsToldAndMended) {
  start_tcp();
  ASSERT_TRUE(run_scans(20)) << connection->message();
  simulator->cut(0, DeviceId::kFront, 1.0);
  ASSERT_TRUE(run_health(Health::kDisconnected));
  ASSERT_TRUE(run_scans(20)) << connection->message();
  EXPECT_GE(connection->counters().reconnects, 1U);
}

TEST_F(HokuyoSim, AnUnpluggedTerminalIsToldAndReopened) {
  start_pty(ScipModel::kUtm30Lx);
  ASSERT_TRUE(run_scans(20)) << connection->message();
  simulator->cut(0, DeviceId::kFront, 1.0);
  ASSERT_TRUE(run_health(Health::kDisconnected));
  ASSERT_TRUE(run_scans(20)) << connection->message();
}

TEST_F(HokuyoSim, SilenceIsToldAndOvercome) {
  start_tcp();
  ASSERT_TRUE(run_scans(20)) << connection->message();
  simulator->silence(0, DeviceId::kFront, 1.2);
  ASSERT_TRUE(run_health(Health::kSilent));
  ASSERT_TRUE(run_scans(20)) << connection->message();
  EXPECT_EQ(connection->health(), Health::kStreaming);
}

TEST_F(HokuyoSim, AFaultySensorIsToldInItsOwnWords) {
  start_tcp();
  ASSERT_TRUE(run_scans(20)) << connection->message();
  simulator->dead(0, DeviceId::kFront, sim::ScipHealth::kFault);
  ASSERT_TRUE(run([&] { return connection->message().find("Trouble!!") != std::string::npos; }))
      << connection->message();
  EXPECT_EQ(connection->health(), Health::kFault);
  simulator->dead(0, DeviceId::kFront, sim::ScipHealth::kGood);
  ASSERT_TRUE(run_scans(20)) << connection->message();
  EXPECT_EQ(connection->health(), Health::kStreaming);
}

TEST_F(HokuyoSim, APowerCycleIsOvercome) {
  start_tcp();
  ASSERT_TRUE(run_scans(20)) << connection->message();
  simulator->reset(0, DeviceId::kFront);
  ASSERT_TRUE(run_scans(60)) << connection->message();
}

TEST_F(HokuyoSim, AClockThatJumpsDoesNotMoveTheStamps) {
  start_tcp();
  ASSERT_TRUE(run_scans(100)) << connection->message();
  const types::Duration before = scan->arrival - scan->first_beam;
  simulator->clock_jump(0, DeviceId::kFront, 123456.0);
  ASSERT_TRUE(run_scans(20)) << connection->message();
  EXPECT_LT(std::abs(types::to_seconds(scan->arrival - scan->first_beam - before)), 0.030);
  EXPECT_EQ(connection->counters().reconnects, 0U);
}

}  // namespace
}  // namespace topo::hokuyo
