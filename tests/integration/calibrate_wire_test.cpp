// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

// Wheels, mounts and gyro through the wires: the drivers speak to devices in the simulation's time, what they
// hear is recorded, and the recording is what calibrates the robot.

#include <gtest/gtest.h>

#include "core/calibration/figure.hpp"
#include "daemon/calibration/calibrated_values.hpp"
#include "daemon/calibration/recorded_drive.hpp"
#include "daemon/config/load.hpp"
#include "daemon/recording/recorder.hpp"
#include "daemon/topoctl/commands.hpp"
#include "drivers/hokuyo/connection.hpp"
#include "drivers/io/tap.hpp"
#include "drivers/pioneer/connection.hpp"
#include "tests/integration/lock_step_robot.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::test {
namespace {

constexpr types::Duration kTurn = std::chrono::milliseconds(5);
constexpr types::Duration kPatience = std::chrono::seconds(20);
/// The simulator's status packets leave 20 to 60 ms after their data; the driver sees the spread of these.
constexpr double kDelay_s = 0.020;

sim::World room() {
  auto world = sim::World::from_scene_text(R"(
[[start]]
x_m = 4.0
y_m = 2.5
[[wall]]
points_m = [[-0.1, -0.1], [8.1, -0.1], [8.1, 6.1], [-0.1, 6.1]]
closed = true
thickness_m = 0.2
[[box]]
center_m = [0.4, 3.0]
length_m = 0.6
width_m = 1.2
z_max_m = 1.2
[[box]]
center_m = [7.6, 1.2]
length_m = 0.5
width_m = 0.8
theta_rad = 0.4
z_max_m = 0.9
)",
                                           "room.toml");
  if (!world) {
    ADD_FAILURE() << world.error().message;
    std::abort();
  }
  return std::move(*world);
}

pioneer::ConnectionConfig base_config() {
  pioneer::ConnectionConfig config;
  config.sonar = false;
  return config;
}

/// Base and scanner in turns, each for a few milliseconds of the simulation's time.
struct Session {
  LockStepRobot& robot;
  pioneer::Connection base;
  std::unique_ptr<hokuyo::Connection> front;
  calibration::DriveLog log;
  types::BaseState state{};
  types::Stamp next_command{};
  std::unique_ptr<types::Scan> scan = std::make_unique<types::Scan>();

  void turn(const types::Twist2& twist) {
    // As often as the base thread does: a setpoint goes before all else that waits for the line.
    if (takes_commands(base.health()) && robot.now() >= next_command) {
      next_command = robot.now() + types::kBasePeriod;
      std::ignore = base.command({.twist = twist, .enable_motors = true, .estop = false, .silence = false});
    }
    if (base.step(state, kTurn) == pioneer::StepOutcome::kState) log.add(state.odometry);
    if (front && front->step(*scan, kTurn) == hokuyo::StepOutcome::kScan) log.add_front(*scan);
  }
  void stand(types::Duration time) {
    for (const types::Stamp end = robot.now() + time; robot.now() < end;) turn({});
  }
  [[nodiscard]] bool connect() {
    const types::Stamp end = robot.now() + kPatience;
    const auto ready = [this] {
      return takes_commands(base.health()) && state.motors_enabled &&
             (!front || front->health() == hokuyo::Health::kStreaming);
    };
    while (robot.now() < end && !ready()) turn({});
    return ready();
  }
};

/// As `topometricd --record` writes it; the rings hold all of it, however fast the simulation is.
std::unique_ptr<daemon::Recorder> recorder_to(const std::string& file) {
  daemon::RecorderOptions options;
  options.path = file;
  options.channels = {"base", "front"};
  options.ring_bytes = std::size_t{1} << 26U;
  auto recorder = daemon::Recorder::start(std::move(options));
  if (!recorder) {
    ADD_FAILURE() << recorder.error().message;
    std::abort();
  }
  return std::move(*recorder);
}

/// What a user would have written down.
constexpr const char* kWritten = R"(
[robot]
model = "p3dx"
[base]
address = "tcp:127.0.0.1:8101"
[scanner.front]
address = "tcp:127.0.0.1:10940"
x_m = 0.10  # by the drawing
)";

daemon::Configuration configuration() {
  const daemon::LoadedConfiguration loaded = daemon::parse_configuration(kWritten, "robot.toml");
  EXPECT_TRUE(loaded.faults.empty()) << daemon::faults_text(loaded);
  return loaded.values;
}

/// `topoctl calibrate RECORDING --config FILE --write`: what was found stands in the file, with its comments.
void expect_command_writes(const std::string& recording, const calibration::RobotNumbers& found) {
  const daemon::testing::TempDir folder;
  const std::string file = folder.write("robot.toml", kWritten);
  daemon::Arguments arguments;
  arguments.calibration = {file, recording, false, true};
  ASSERT_EQ(daemon::calibrate_robot(arguments), daemon::kOk);
  EXPECT_EQ(daemon::testing::read_all(file + ".1"), kWritten);
  EXPECT_NE(daemon::testing::read_all(file).find("# by the drawing"), std::string::npos);
  const auto loaded = daemon::load_configuration(file);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(daemon::faults_text(*loaded), "");
  constexpr double kRounding = 1e-5;
  const daemon::Configuration& got = loaded->values;
  EXPECT_NEAR(got.base.wheels.left, found.wheels.left, kRounding);
  EXPECT_NEAR(got.base.wheels.right, found.wheels.right, kRounding);
  EXPECT_NEAR(got.base.wheels.track_m, found.wheels.track_m, kRounding);
  EXPECT_NEAR(got.front.yaw_rad, found.T_base_laser.theta_rad, kRounding);
  EXPECT_NEAR(got.front.x_m, found.T_base_laser.x_m, kRounding);
}

TEST(CalibrateWire, TheBuiltInFigureMeetsTheBars) {
  LockStepSetup setup;
  setup.front = {0.128, 0.028, 0.30, 7.0 * types::kDegree_rad, sim::ScanPlane::kLevel, 0.0};
  setup.difficulty.wheel_scale_error = 0.04;
  setup.difficulty.track_error = 0.08;
  LockStepRobot robot(room(), setup, 3);
  const daemon::testing::TempDir folder;
  const std::string file = folder.file("drive.rec");
  const auto recorder = recorder_to(file);
  const auto tapped = [&](std::unique_ptr<io::Connector> connector, const char* channel) {
    return std::make_unique<io::TappedConnector>(std::move(connector), recorder->tap(channel));
  };
  auto front = std::make_unique<hokuyo::Connection>(hokuyo::ConnectionConfig{},
                                                    tapped(robot.front_connector(), "front"));
  Session session{robot, pioneer::Connection(base_config(), tapped(robot.base_connector(), "base")),
                  std::move(front), calibration::DriveLog(robot.body().model().track_m, 0.1)};
  ASSERT_TRUE(session.connect()) << session.base.message() << "; " << session.front->message();
  const types::Stamp start = robot.now();
  for (auto twist = calibration::figure_twist(0.0); twist;
       twist = calibration::figure_twist(types::to_seconds(robot.now() - start)))
    session.turn(*twist);
  ASSERT_EQ(robot.body().collisions(), 0U);

  ASSERT_TRUE(recorder->stop());

  const auto drive = daemon::recorded_drive(file, configuration(), 0.1);
  ASSERT_TRUE(drive) << drive.error().message;
  EXPECT_GT(drive->odometry().size() + 20, session.log.odometry().size()) << "the replay lost status packets";
  EXPECT_GT(drive->front().size() + 20, session.log.front().size()) << "the replay lost scans";
  const calibration::Assumed before = daemon::assumed(configuration(), drive->model_track_m());
  const calibration::Calibration found = calibration::calibrate(*drive, before, {});
  ASSERT_TRUE(found.believable());
  EXPECT_EQ(daemon::calibrated_values(found, before).size(), 7U);
  const calibration::RobotNumbers& got = found.fit->numbers;
  const types::WheelCalibration truth = robot.body().true_wheels();
  const types::Se2 off = types::Se2{0.128, 0.028, 7.0 * types::kDegree_rad}.inverse() * got.T_base_laser;
  EXPECT_NEAR(off.theta_rad, 0.0, 0.3 * types::kDegree_rad);
  EXPECT_LT(off.translation().norm(), 0.01);
  EXPECT_NEAR(got.wheels.left / truth.left, 1.0, 0.003);
  EXPECT_NEAR(got.wheels.right / truth.right, 1.0, 0.003);
  EXPECT_NEAR(got.wheels.track_m / truth.track_m, 1.0, 0.005);
  EXPECT_NEAR(got.delay_s, kDelay_s, 0.005);
  expect_command_writes(file, got);
}

/// Error of the heading after turns to the left on the spot, in radians a turn.
double error_a_turn(bool gyro, std::uint64_t seed) {
  LockStepSetup setup;
  setup.model = "p3at";
  setup.has_front = false;
  setup.difficulty.skid = 0.2;
  LockStepRobot robot(room(), setup, seed);
  pioneer::ConnectionConfig config = base_config();
  config.gyro = gyro;
  Session session{robot, pioneer::Connection(config, robot.base_connector()), nullptr,
                  calibration::DriveLog(robot.body().model().track_m, 0.1)};
  EXPECT_TRUE(session.connect()) << session.base.message();
  session.stand(std::chrono::seconds(3));
  const double before_rad = session.state.odometry.T_odom_base.theta_rad();
  const double true_before_rad = robot.body().truth().theta_rad;
  double turned_rad = 0.0, last_rad = true_before_rad;
  while (turned_rad < 4.0 * M_PI) {
    session.turn({0.0, 0.8});
    turned_rad += types::wrap_angle(robot.body().truth().theta_rad - last_rad);
    last_rad = robot.body().truth().theta_rad;
  }
  session.stand(std::chrono::seconds(2));
  turned_rad += types::wrap_angle(robot.body().truth().theta_rad - last_rad);
  // Two turns and a rest: the sum of the steps, because a heading alone does not tell whole turns.
  double told_rad = 0.0, told_last_rad = before_rad;
  for (const types::Odometry& sample : session.log.odometry()) {
    told_rad += types::wrap_angle(sample.T_odom_base.theta_rad() - told_last_rad);
    told_last_rad = sample.T_odom_base.theta_rad();
  }
  return std::abs(told_rad - turned_rad) / (turned_rad / (2.0 * M_PI));
}

TEST(GyroWire, ASkiddingRobotKeepsItsHeading) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const double wheels = error_a_turn(false, seed), gyro = error_a_turn(true, seed);
    RecordProperty("wheels_rad_a_turn_seed_" + std::to_string(seed), std::to_string(wheels));
    RecordProperty("gyro_rad_a_turn_seed_" + std::to_string(seed), std::to_string(gyro));
    EXPECT_GT(wheels, 0.8) << "20 % skid must show";
    EXPECT_LT(gyro, wheels / 10.0) << "seed " << seed;
  }
}

}  // namespace
}  // namespace topo::test
