// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <deque>
#include <optional>
#include <utility>

#include "tests/bench/topobench/explore/calibrated_reckoning.hpp"
#include "tests/bench/topobench/explore/plant.hpp"
#include "tests/bench/topobench/explore/virtual_base.hpp"
#include "tests/sim/value_feed.hpp"

namespace topo::bench {
namespace {

constexpr sim::SimTime kCoronalPhase = std::chrono::microseconds(9300);  // two mirrors do not turn in step
constexpr types::Duration kStatusDelay = std::chrono::milliseconds(40);  // 20 to 60 ms on the wire

sim::RobotSetup robot_setup(const PlantSetup& plant) {
  const slam::MapperParams& at = plant.mapping;
  sim::RobotSetup setup;
  setup.start = plant.start;
  sim::LaserSetup front, coronal;
  front.mount = {at.T_base_laser.x_m, at.T_base_laser.y_m, kFrontHeight_m, at.T_base_laser.theta_rad,
                 sim::ScanPlane::kLevel};
  coronal.mount = {at.coronal.x_m,           at.coronal.y_m,     at.coronal.z_m, 0.0,
                   sim::ScanPlane::kCoronal, at.coronal.roll_rad};
  coronal.phase = kCoronalPhase;
  setup.lasers = {front, coronal};
  return setup;
}

class FullPlant final : public Plant, private sim::SensorSink {
 public:
  FullPlant(std::shared_ptr<sim::Simulation> simulation, const PlantSetup& setup)
      : driver_(setup.driver),
        base_(setup.limits, setup.firmware_watchdog, sim::arcos::p3dx_parameters(), driver_.wheels),
        reckoning_(driver_.wheels),
        feed_(robot_setup(setup)),
        simulation_(std::move(simulation)),
        time_(simulation_->now()) {}
  ~FullPlant() override {
    if (!robot_) return;
    simulation_->set_sink(*robot_, nullptr);
    simulation_->set_drive(*robot_, nullptr);
  }
  FullPlant(const FullPlant&) = delete;
  FullPlant& operator=(const FullPlant&) = delete;

  types::Status place(const PlantSetup& setup) {
    sim::RobotSetup robot = robot_setup(setup);
    robot.drive = &base_;
    robot.sink = this;
    const auto added = simulation_->add_robot(robot);
    if (!added) return tl::unexpected(added.error());
    robot_ = *added;
    return {};
  }

  void tick(Readings& out) override {
    time_ += kTick;
    simulation_->advance_to(time_);  // of several robots the first one's tick moves all
    feed_.sample(body());
    while (const auto counted = feed_.next_odometry()) {
      const types::Stamp arrival = counted->stamp + kStatusDelay + driver_.status_delay;
      types::Odometry odometry = reckoning_.update(*counted);
      odometry.stamp += driver_.status_delay - driver_.told_delay;
      on_the_way_.push_back(base_.status(odometry, arrival, body()));
    }
    const types::Stamp now{simulation_->now()};
    for (; !on_the_way_.empty() && on_the_way_.front().arrival <= now; on_the_way_.pop_front())
      out.states.push_back(on_the_way_.front());
    while (feed_.next_scan(0, scan_)) out.front.push_back(scan_);
    while (feed_.next_scan(1, scan_)) out.coronal.push_back(scan_);
  }

  void command(const types::BaseCommand& command) override { base_.command(command, time_); }
  [[nodiscard]] sim::SimTime now() const override { return time_; }
  [[nodiscard]] const sim::World& world() const override { return simulation_->world(); }
  [[nodiscard]] sim::RobotBody& body() override { return simulation_->body(*robot_); }

 private:
  void on_sweep(std::size_t laser, const sim::Sweep& sweep) override { feed_.on_sweep(laser, sweep); }
  void on_sonar(const sim::SonarEcho& echo) override { base_.on_sonar(echo); }

  DriverSetup driver_;
  VirtualBase base_;
  CalibratedReckoning reckoning_;
  sim::ValueFeed feed_;
  std::deque<types::BaseState> on_the_way_;
  types::Scan scan_;
  std::shared_ptr<sim::Simulation> simulation_;
  sim::SimTime time_;  ///< that this robot has lived through
  std::optional<std::size_t> robot_;
};

}  // namespace

types::Result<std::unique_ptr<Plant>> make_full_plant(sim::World world, const PlantSetup& setup) {
  return make_full_plant(std::make_shared<sim::Simulation>(std::move(world), setup.difficulty, setup.seed),
                         setup);
}

types::Result<std::unique_ptr<Plant>> make_full_plant(std::shared_ptr<sim::Simulation> simulation,
                                                      const PlantSetup& setup) {
  auto plant = std::make_unique<FullPlant>(std::move(simulation), setup);
  if (auto placed = plant->place(setup); !placed) return tl::unexpected(placed.error());
  return std::unique_ptr<Plant>(std::move(plant));
}

}  // namespace topo::bench
