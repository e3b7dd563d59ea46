// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/slam/simulated_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <deque>

#include "drivers/pioneer/sip_delay.hpp"
#include "tests/bench/topobench/explore/calibrated_reckoning.hpp"
#include "tests/bench/topobench/slam/patrol.hpp"
#include "tests/sim/random.hpp"
#include "tests/sim/value_feed.hpp"

namespace topo::bench {
namespace {

constexpr double kLaserAhead_m = 0.10, kLaserHeight_m = 0.30;  // config/simulation.toml
constexpr double kClearance_m = 0.34;                          // of the way: swing radius and steering
constexpr double kPeopleClearance_m = 0.30;
constexpr sim::SimTime kTick = std::chrono::milliseconds(5);
constexpr double kLatest_s = 0.060, kEarliest_s = 0.020;  // of status packets, as toposim has it

/// Lets a robot wait for people who stand or walk before it, as a person at the joystick would.
class CarefulDrive final : public sim::WheelDrive {
 public:
  CarefulDrive(const sim::World& world, sim::WayPointDrive& driver) : world_(world), driver_(driver) {}

  sim::WheelSpeeds wheel_speeds(sim::SimTime now, sim::SimTime dt, const sim::RobotBody& body) override {
    const bool ahead = blocked(body);
    if (ahead) return {};
    return driver_.wheel_speeds(now, dt, body);
  }

 private:
  [[nodiscard]] bool blocked(const sim::RobotBody& body) {
    // Every tenth step is soon enough, and a tenth of the cost.
    if (++step_ % 10 != 1) return blocked_;
    const sim::Se2 ahead = body.truth() * sim::Se2{0.25, 0.0, 0.0};
    blocked_ = world_.touch(body.model().footprint(), ahead, kKnee_m, body.model().height_m, body.movable())
                   .touching;
    return blocked_;
  }
  static constexpr double kKnee_m = 0.9;  ///< higher than furniture: only people and walls
  const sim::World& world_;
  sim::WayPointDrive& driver_;
  int step_ = 0;
  bool blocked_ = false;
};

sim::RobotSetup robot_at(const sim::Se2& start, const sim::Se2& T_base_laser) {
  sim::RobotSetup setup;
  setup.start = start;
  setup.lasers.resize(1);
  setup.lasers[0].mount.x_m = T_base_laser.x_m;
  setup.lasers[0].mount.y_m = T_base_laser.y_m;
  setup.lasers[0].mount.yaw_rad = T_base_laser.theta_rad;
  setup.lasers[0].mount.z_m = kLaserHeight_m;
  return setup;
}

/// Status packets on their way: late, and stamped by the driver's estimate of how late, or, of a driver that
/// is set up, by what it is told.
class LatePackets {
 public:
  LatePackets(const std::optional<DriverSetup>& driver, std::uint64_t seed) : driver_(driver), random_(seed) {
    if (driver) reckoning_.emplace(driver->wheels);
  }
  void send(const types::Odometry& odometry) {
    if (driver_) {
      waiting_.push_back({reckoning_->update(odometry), odometry.stamp + driver_->status_delay});
      return;
    }
    const auto late = types::from_seconds(random_.uniform(kEarliest_s, kLatest_s));
    types::Stamp arrival = odometry.stamp + late;
    if (!waiting_.empty()) arrival = std::max(arrival, waiting_.back().arrival);
    waiting_.push_back({odometry, arrival});
  }
  [[nodiscard]] std::optional<types::Odometry> receive(types::Stamp now) {
    if (waiting_.empty() || waiting_.front().arrival > now) return std::nullopt;
    types::Odometry odometry = waiting_.front().odometry;
    const types::Stamp arrival = waiting_.front().arrival;
    waiting_.pop_front();
    odometry.stamp =
        driver_ ? arrival - driver_->told_delay : arrival - delay_.update(arrival, types::Duration::zero());
    return odometry;
  }

 private:
  struct Packet {
    types::Odometry odometry;
    types::Stamp arrival;
  };
  std::optional<DriverSetup> driver_;
  std::optional<CalibratedReckoning> reckoning_;  ///< of that driver
  sim::Random random_;
  pioneer::SipDelay delay_;
  std::deque<Packet> waiting_;
};

void add_people(sim::Simulation& simulation, int people, const sim::Vector2& start, std::uint64_t seed) {
  for (int i = 0; i < people; ++i) {
    // Everybody has a round of his own, begun at another place of it.
    sim::Walker walker;
    walker.way_points = patrol(simulation.world().structure(), start, kPeopleClearance_m, 150.0,
                               seed + 1000 + static_cast<std::uint64_t>(i));
    if (walker.way_points.size() < 2) continue;
    std::vector<sim::Vector2> back(walker.way_points.rbegin() + 1, walker.way_points.rend() - 1);
    walker.way_points.insert(walker.way_points.end(), back.begin(), back.end());
    std::rotate(walker.way_points.begin(),
                walker.way_points.begin() + static_cast<std::ptrdiff_t>(walker.way_points.size() / 3),
                walker.way_points.end());
    simulation.add_walker(std::move(walker));
  }
}

class Runner {
 public:
  Runner(sim::Simulation& simulation, const SimulatedSetup& setup, pipeline::MappingState& state)
      : simulation_(simulation),
        setup_(setup),
        start_(simulation.world().start_poses().front()),
        robot_(robot_at(start_, setup.T_base_laser)),
        feed_(robot_),
        packets_(setup.driver, setup.seed ^ 0x51bU),
        thinner_(setup.thinning),
        lock_step_(state) {}

  types::Result<SimulatedRun> run() {
    const double length = setup_.limits.v_max_mps * 60.0 * setup_.minutes;
    std::vector<sim::Vector2> way =
        patrol(simulation_.world().structure(), start_.translation(), kClearance_m, length, setup_.seed);
    if (way.size() < 2) {
      return types::fail(
          types::Errc::kInvalidInput,
          fmt::format("world '{}': no way from the start ({:g}, {:g}) has {:g} m on both sides",
                      simulation_.world().name(), start_.x_m, start_.y_m, kClearance_m));
    }
    sim::WayPointDrive driver(std::move(way), 1, setup_.limits);
    CarefulDrive drive(simulation_.world(), driver);
    robot_.drive = setup_.people > 0 ? static_cast<sim::WheelDrive*>(&drive) : &driver;
    robot_.sink = &feed_;
    const auto index = simulation_.add_robot(robot_);
    if (!index) return tl::unexpected(index.error());
    add_people(simulation_, setup_.people, start_.translation(), setup_.seed);
    body_ = &simulation_.body(*index);
    lock_step_.on_match = [this](const slam::MatchReport& match) {
      truth_.push_back(body_->pose_at(match.stamp.time_since_epoch()));
    };
    drive_until_the_end(driver);
    simulation_.set_sink(*index, nullptr);
    simulation_.set_drive(*index, nullptr);
    return finish();
  }

 private:
  void drive_until_the_end(const sim::WayPointDrive& driver) {
    const auto end = types::from_seconds(60.0 * setup_.minutes);
    types::Scan scan;
    while (simulation_.now() < end && !driver.finished()) {
      simulation_.advance_to(simulation_.now() + kTick);
      feed_.sample(*body_);
      while (const auto odometry = feed_.next_odometry()) {
        odom_ = odometry->T_odom_base.se2();
        packets_.send(*odometry);
      }
      while (const auto odometry = packets_.receive(types::Stamp{simulation_.now()}))
        lock_step_.step({{&*odometry, 1}, nullptr, nullptr});
      while (feed_.next_scan(0, scan)) {
        if (!thinner_.keeps_next()) continue;
        ++out_.scans;
        lock_step_.step({{}, &scan, nullptr});
      }
    }
  }

  SimulatedRun finish() {
    out_.run = lock_step_.finish();
    truth_.resize(out_.run.trajectory.size(), body_->truth());
    for (std::size_t i = 0; i < truth_.size(); ++i) {
      out_.corrected.push_back({out_.run.trajectory[i].pose, truth_[i]});
      out_.live.push_back({out_.run.live[i].pose, truth_[i]});
    }
    out_.path_m = body_->path_m();
    out_.collisions = body_->collisions();
    out_.odometry_m = ((start_ * odom_).translation() - body_->truth().translation()).norm();
    return std::move(out_);
  }

  sim::Simulation& simulation_;
  const SimulatedSetup& setup_;
  sim::Se2 start_;
  sim::RobotSetup robot_;
  sim::ValueFeed feed_;
  LatePackets packets_;
  Thinner thinner_;
  LockStep lock_step_;
  const sim::RobotBody* body_ = nullptr;
  sim::Se2 odom_;
  std::vector<sim::Se2> truth_;
  SimulatedRun out_;
};

}  // namespace

slam::MapperParams simulated_robot_params() {
  slam::MapperParams params;
  params.T_base_laser = {kLaserAhead_m, 0.0, 0.0};
  return params;
}

types::Result<SimulatedRun> run_simulated(sim::Simulation& simulation, const SimulatedSetup& setup,
                                          pipeline::MappingState& state) {
  return Runner(simulation, setup, state).run();
}

}  // namespace topo::bench
