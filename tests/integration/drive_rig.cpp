// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/integration/drive_rig.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/grid/distance.hpp"
#include "core/grid/wavefront.hpp"
#include "core/travel/path.hpp"

namespace topo::test {
namespace {

using sim::Se2;
using sim::SimTime;
using sim::Vector2;

constexpr SimTime kTick = std::chrono::milliseconds(5);
constexpr SimTime kControlPeriod = std::chrono::milliseconds(50);
constexpr SimTime kPlanPeriod = std::chrono::milliseconds(500);
constexpr types::Duration kStatusDelay = std::chrono::milliseconds(40);

bool is_at(const std::string& model) { return model == "p3at"; }

sim::RobotModel robot_model(const std::string& model) {
  return is_at(model) ? sim::RobotModel::p3at() : sim::RobotModel::p3dx();
}

sim::RobotSetup robot_setup(const DriveSetup& setup) {
  sim::RobotSetup robot;
  robot.model = robot_model(setup.model);
  robot.start = setup.start;
  sim::LaserSetup front;
  front.mount.x_m = control_setup(setup.model).T_base_laser.x_m;
  robot.lasers = {front};
  return robot;
}

grid::DenseMap dense_map_of(const sim::World& world) {
  const sim::Raster& free = world.structure();
  grid::DenseMap map;
  map.resolution_m = free.resolution_m;
  const grid::CellIndex min = map.cell_at(free.center(0, 0));
  map.box = {min, {min.x + free.width - 1, min.y + free.height - 1}};
  map.cells.resize(free.cells.size());
  std::transform(free.cells.begin(), free.cells.end(), map.cells.begin(), [](std::uint8_t is_free) {
    return is_free != 0 ? grid::CellState::kFree : grid::CellState::kOccupied;
  });
  return map;
}

}  // namespace

pipeline::ControlSetup control_setup(const std::string& model) {
  pipeline::ControlSetup setup;
  setup.limits.footprint = is_at(model) ? types::Footprint{0.313, 0.313, 0.2525, 0.340}
                                        : types::Footprint{0.210, 0.301, 0.2125, 0.267};
  setup.T_base_laser.x_m = is_at(model) ? 0.125 : 0.021;
  if (is_at(model)) setup.limits.v_max_mps = 0.6;
  if (is_at(model)) setup.limits.omega_max_radps = 1.2;
  return setup;
}

std::vector<Vector2> way_in(const sim::World& world, const Vector2& from, const Vector2& to) {
  const grid::DenseMap map = dense_map_of(world);
  const std::vector<float> clearance = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
  const grid::TravelRules rules;
  const grid::TravelField field = grid::travel_field(map, clearance, map.cell_at(from), rules);
  const auto route = grid::route_to(map, field, map.cell_at(to));
  return travel::smooth_path(map, clearance, route, rules.preferred_m, {});
}

void DriveRig::Sink::on_sweep(std::size_t laser, const sim::Sweep& sweep) {
  rig_.feed_.on_sweep(laser, sweep);
}
void DriveRig::Sink::on_sonar(const sim::SonarEcho& echo) { rig_.base_.on_sonar(echo); }

namespace {
pipeline::ControlSetup setup_of(const DriveSetup& drive) {
  pipeline::ControlSetup setup = control_setup(drive.model);
  if (drive.v_max_mps) setup.limits.v_max_mps = *drive.v_max_mps;
  return setup;
}
}  // namespace

DriveRig::DriveRig(sim::World world, const DriveSetup& drive)
    : setup(setup_of(drive)),
      told_watchdog(drive.watchdog),
      base_(setup.limits, drive.watchdog,
            is_at(drive.model) ? sim::arcos::p3at_parameters() : sim::arcos::p3dx_parameters()),
      feed_(robot_setup(drive)),
      sink_(*this),
      simulation_(std::make_unique<sim::Simulation>(std::move(world), drive.difficulty, drive.seed)),
      scan_(std::make_unique<types::Scan>()),
      incoming_(std::make_unique<types::Scan>()) {
  sim::RobotSetup robot = robot_setup(drive);
  robot.drive = &base_;
  robot.sink = &sink_;
  for (const sim::SonarMount& mount : robot.model.sonars)
    T_base_sonar_.push_back({mount.x_m, mount.y_m, mount.heading_rad});
  const auto added = simulation_->add_robot(robot);
  if (!added) std::abort();
  T_building_odom_ = drive.start;
}

void DriveRig::go(std::vector<Vector2> route) {
  route_ = std::move(route);
  route_at_ = 0;
  ++plan_.goal_id;
  plan();
}

void DriveRig::plan() {
  if (planner_silent) return;
  plan_.stamp = types::Stamp{simulation_->now()};
  ++plan_.sequence;
  plan_.moving = !route_.empty() && !lost;
  plan_.located = !lost;
  plan_.T_map_odom = types::Transform2<types::Map, types::Odom>(T_building_odom_);
  if (!plan_.moving) return;
  const Vector2 here = body().truth().translation();
  const std::size_t search_end = std::min(route_.size(), route_at_ + 20);
  for (std::size_t i = route_at_; i < search_end; ++i)
    if ((route_[i] - here).norm() < (route_[route_at_] - here).norm()) route_at_ = i;
  put_path(std::span(route_).subspan(route_at_), plan_.T_map_odom, plan_);
  plan_.path_ends_at_goal = route_.size() - route_at_ <= plan_.points;
}

void DriveRig::sense() {
  feed_.sample(simulation_->body(0));
  while (const auto odometry = feed_.next_odometry()) {
    T_building_odom_ =
        body().pose_at(odometry->stamp - types::Stamp{}) * odometry->T_odom_base.se2().inverse();
    on_the_way_.push_back(base_.status(*odometry, odometry->stamp + kStatusDelay, body()));
  }
  const types::Stamp now{simulation_->now()};
  for (; !on_the_way_.empty() && on_the_way_.front().arrival <= now; on_the_way_.pop_front()) {
    if (base_silent) continue;
    state_ = on_the_way_.front();
    if (spoil_state) spoil_state(state_);
    has_state_ = true;
  }
  while (feed_.next_scan(0, *incoming_)) {
    if (front_silent) continue;
    std::swap(scan_, incoming_);
    if (spoil_scan) spoil_scan(*scan_);
    has_scan_ = true;
  }
}

void DriveRig::control() {
  pipeline::ControlInput in;
  in.now = types::Stamp{simulation_->now()};
  in.estop = estop;
  in.estop_cleared = std::exchange(estop_cleared, false);
  if (by_hand) teleop_ = {in.now, *by_hand};
  in.teleop = &teleop_;
  in.plan = plan_.sequence > 0 ? &plan_ : nullptr;
  in.state = has_state_ ? &state_ : nullptr;
  in.front = has_scan_ ? scan_.get() : nullptr;
  in.T_base_sonar = T_base_sonar_;
  in.firmware_watchdog = told_watchdog;
  if (match) matched_ = match();
  in.matched = match ? &matched_ : nullptr;
  out_ = pipeline::control_step(state_of_control_, setup, in);
  if (carry)
    carry(out_.command, base_, simulation_->now());
  else
    base_.command(out_.command, simulation_->now());
}

void DriveRig::tick() {
  simulation_->advance_to(simulation_->now() + kTick);
  sense();
}

bool DriveRig::run(double seconds, const std::function<bool()>& done) {
  const double end_s = now_s() + seconds;
  while (now_s() < end_s) {
    tick();
    if (simulation_->now() % kControlPeriod != SimTime{0}) continue;
    if (simulation_->now() % kPlanPeriod == SimTime{0}) plan();
    if (!host_dead) control();
    if (done()) return true;
  }
  return false;
}

}  // namespace topo::test
