// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/devices/sim_rig.hpp"

#include <algorithm>
#include <ctime>
#include <utility>

#include "tests/sim/devices/commands.hpp"
#include "tests/sim/random.hpp"

namespace topo::sim {
namespace {

constexpr SimTime kBatch = std::chrono::milliseconds{10};      // steps between two services of the wires
constexpr SimTime kLate = std::chrono::milliseconds{20};       // counted as an overrun
constexpr SimTime kHopeless = std::chrono::milliseconds{500};  // skipped instead of caught up

double steady_seconds(std::chrono::steady_clock::time_point t) {
  return std::chrono::duration<double>(t.time_since_epoch()).count();
}

}  // namespace

SimRig::SimRig(World world, const RigConfig& config)
    : config_(config), simulation_(std::move(world), config.difficulty, config.seed), epoch_(Clock::now()) {}

types::Result<std::unique_ptr<SimRig>> SimRig::create(World world, const RigConfig& config) {
  std::unique_ptr<SimRig> rig(new SimRig(std::move(world), config));
  if (auto status = rig->place_robots(); !status.has_value()) return tl::unexpected(status.error());
  // Before the truth file is opened: another simulation may be writing it.
  if (!config.control_socket.empty()) {
    auto server = ControlServer::listen(config.control_socket);
    if (!server.has_value()) return tl::unexpected(server.error());
    rig->control_ = std::move(*server);
  }
  if (!config.truth_file.empty()) {
    auto status = rig->truth_.open(config.truth_file, config.robots.size(), config.difficulty.text());
    if (!status.has_value()) return tl::unexpected(status.error());
  }
  rig->epoch_ = Clock::now();
  return rig;
}

types::Status SimRig::place_robots() {
  const auto starts = simulation_.world().start_poses();
  for (std::size_t i = 0; i < config_.robots.size(); ++i) {
    const RobotConfig& robot = config_.robots[i];
    if (!robot.start && i >= starts.size()) {
      return types::fail(types::Errc::kInvalidInput,
                         simulation_.world().name() + ": robot " + std::to_string(i) +
                             " has no start: the world names " + std::to_string(starts.size()) +
                             ", give the others with --start");
    }
    robots_.push_back(std::make_unique<RobotRig>(robot, i, derive_seed(config_.seed, 77, i)));
    auto added = simulation_.add_robot(robots_.back()->setup(robot.start ? *robot.start : starts[i]));
    if (!added.has_value()) return tl::unexpected(added.error());
    if (auto status = robots_.back()->open(); !status.has_value()) return status;
  }
  return {};
}

double SimRig::epoch_s() const { return steady_seconds(epoch_); }

Truth SimRig::truth(std::size_t robot) const {
  const RobotBody& body = simulation_.body(robot);
  const double sim_s = seconds_of(simulation_.now());
  return {body.truth(), body.collisions(), body.path_m(), epoch_s() + sim_s, sim_s};
}

void SimRig::catch_up() {
  const SimTime elapsed = Clock::now() - epoch_;
  const SimTime behind = elapsed - simulation_.now();
  if (behind > kLate) ++overruns_;
  if (behind > kHopeless) {
    // The machine is too slow: the simulation's time pauses instead of lagging behind forever.
    epoch_ += std::chrono::duration_cast<Clock::duration>(behind);
    lost_s_ += seconds_of(behind);
    return;
  }
  simulation_.advance_to(std::min(elapsed, simulation_.now() + kBatch));
  now_ = std::max({now_, simulation_.now(), std::min(elapsed, simulation_.now() + Simulation::kStep)});
}

void SimRig::wait() {
  fds_.clear();
  for (const auto& robot : robots_) robot->append_poll(fds_);
  if (control_) control_->append_poll(fds_);
  const SimTime left = simulation_.now() + Simulation::kStep - (Clock::now() - epoch_);
  if (left <= SimTime{0}) return;
  const timespec timeout{0, static_cast<long>(std::min<SimTime::rep>(left.count(), 10'000'000))};
  ::ppoll(fds_.data(), fds_.size(), &timeout, nullptr);
}

void SimRig::iterate() {
  catch_up();
  for (auto& robot : robots_) robot->pump(now_);
  truth_.record(simulation_, epoch_s());
  if (control_) {
    control_->serve([this](const std::string& line) { return run_command(*this, line); });
  }
  wait();
}

}  // namespace topo::sim
