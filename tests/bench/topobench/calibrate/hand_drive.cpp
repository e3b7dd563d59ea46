// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/calibrate/hand_drive.hpp"

#include <chrono>
#include <utility>
#include <vector>

#include "tests/sim/value_feed.hpp"
#include "tests/sim/way_point_drive.hpp"

namespace topo::bench {
namespace {

constexpr double kScanPeriod_s = 0.1;

std::vector<sim::Vector2> way_by_hand() {
  return {{6.0, 1.3}, {6.6, 3.0}, {6.0, 4.6}, {2.0, 4.6}, {1.4, 3.0}, {4.0, 3.0}, {6.0, 4.6},
          {6.6, 3.0}, {6.0, 1.3}, {4.0, 3.0}, {2.0, 4.6}, {1.4, 3.0}, {2.0, 1.5}};
}

std::vector<sim::LaserSetup> scanners_of(const TrueRobot& truth, bool coronal) {
  std::vector<sim::LaserSetup> lasers(coronal ? 2 : 1);
  // Ten turns a second in place of forty: the others would be left out, and casting them is most of the cost.
  for (sim::LaserSetup& laser : lasers) laser.model.rpm = 600;
  lasers[0].mount = {truth.T_base_laser.x_m,       truth.T_base_laser.y_m, kLevelHeight_m,
                     truth.T_base_laser.theta_rad, sim::ScanPlane::kLevel, 0.0};
  const walls::CoronalMount& upright = truth.coronal;
  if (coronal)
    lasers[1].mount = {upright.x_m,     upright.y_m, upright.z_m, 0.0, sim::ScanPlane::kCoronal,
                       upright.roll_rad};
  return lasers;
}

/// Takes what the robot measures for as long as the course lasts.
class Recording {
 public:
  Recording(sim::Simulation& simulation, const Course& course, const TrueRobot& truth, sim::ValueFeed& feed)
      : simulation_(simulation), course_(course), truth_(truth), feed_(feed) {}

  calibration::DriveLog record(std::size_t robot) {
    calibration::DriveLog log(simulation_.body(robot).model().track_m, kScanPeriod_s);
    while (types::to_seconds(simulation_.now()) < course_.seconds) {
      simulation_.advance_to(simulation_.now() + std::chrono::milliseconds(5));
      feed_.sample(simulation_.body(robot));
      take(log);
    }
    return log;
  }

 private:
  void take(calibration::DriveLog& log) {
    while (auto odometry = feed_.next_odometry()) {
      odometry->stamp += types::from_seconds(truth_.delay_s);
      log.add(*odometry);
    }
    while (feed_.next_scan(0, scan_)) {
      if (course_.spoil) course_.spoil(scan_, types::to_seconds(scan_.first_beam));
      log.add_front(scan_);
    }
    while (course_.coronal && feed_.next_scan(1, scan_)) log.add_coronal(scan_);
  }

  sim::Simulation& simulation_;
  const Course& course_;
  const TrueRobot& truth_;
  sim::ValueFeed& feed_;
  types::Scan scan_;
};

}  // namespace

std::string furnished_room() {
  return R"(
[[start]]
x_m = 2.0
y_m = 1.5
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
center_m = [5.0, 5.7]
length_m = 1.4
width_m = 0.5
z_max_m = 1.8
[[box]]
center_m = [7.6, 1.2]
length_m = 0.5
width_m = 0.8
theta_rad = 0.4
z_max_m = 0.9
)";
}

types::Result<HandDrive> drive_by_hand(const Course& course, const TrueRobot& truth, std::uint64_t seed) {
  auto world = sim::World::from_scene_text(course.world, "room.toml");
  if (!world) return tl::unexpected(world.error());
  sim::RobotSetup setup;
  setup.start = world->start_poses().front();
  setup.lasers = scanners_of(truth, course.coronal);
  sim::Simulation simulation(std::move(*world), course.difficulty, seed);
  sim::ValueFeed feed(setup);
  sim::WayPointDrive by_hand(way_by_hand(), 0);
  setup.drive = course.drive != nullptr ? course.drive : &by_hand;
  setup.sink = &feed;
  const auto robot = simulation.add_robot(setup);
  if (!robot) return tl::unexpected(robot.error());
  HandDrive out{Recording(simulation, course, truth, feed).record(*robot),
                simulation.body(*robot).true_wheels()};
  simulation.set_sink(*robot, nullptr);
  simulation.set_drive(*robot, nullptr);
  if (simulation.body(*robot).collisions() > 0)
    return types::fail(types::Errc::kInvalidInput, "the robot touched something on its drive by hand");
  return out;
}

}  // namespace topo::bench
