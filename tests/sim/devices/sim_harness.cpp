// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/devices/sim_harness.hpp"

#include "tests/sim/devices/commands.hpp"

namespace topo::sim {

types::Result<std::unique_ptr<SimHarness>> SimHarness::start(World world, const RigConfig& config) {
  auto rig = SimRig::create(std::move(world), config);
  if (!rig.has_value()) return tl::unexpected(rig.error());
  return std::unique_ptr<SimHarness>(new SimHarness(std::move(*rig)));
}

SimHarness::SimHarness(std::unique_ptr<SimRig> rig) : rig_(std::move(rig)) {
  for (std::size_t robot = 0; robot < rig_->robot_count(); ++robot) {
    auto& addresses = addresses_.emplace_back();
    for (std::size_t device = 0; device < kDeviceCount; ++device) {
      addresses[device] = rig_->robot(robot).wire(static_cast<DeviceId>(device)).address();
    }
  }
  thread_ = std::thread([this] { run(); });
}

SimHarness::~SimHarness() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  thread_.join();
}

void SimHarness::post(std::function<void(SimRig&)> job) {
  const std::lock_guard lock(mutex_);
  jobs_.push_back(std::move(job));
}

bool SimHarness::take_jobs(std::vector<std::function<void(SimRig&)>>& jobs) {
  const std::lock_guard lock(mutex_);
  jobs.swap(jobs_);
  return !stop_;
}

void SimHarness::run() {
  std::vector<std::function<void(SimRig&)>> jobs;
  while (take_jobs(jobs)) {
    for (const auto& job : jobs) job(*rig_);
    jobs.clear();
    rig_->iterate();
  }
}

std::string SimHarness::command(const std::string& line) {
  return with_rig([&line](SimRig& rig) { return run_command(rig, line); });
}

void SimHarness::silence(std::size_t robot, DeviceId device, double seconds) {
  with_rig([=](SimRig& rig) { rig.robot(robot).wire(device).silence(rig.now() + sim_seconds(seconds)); });
}
void SimHarness::cut(std::size_t robot, DeviceId device, double seconds) {
  with_rig([=](SimRig& rig) { rig.robot(robot).wire(device).cut(rig.now() + sim_seconds(seconds)); });
}
void SimHarness::garbage(std::size_t robot, DeviceId device, std::size_t bytes) {
  with_rig([=](SimRig& rig) { rig.robot(robot).wire(device).garbage(bytes); });
}
void SimHarness::slow(std::size_t robot, DeviceId device, double bytes_per_s) {
  with_rig([=](SimRig& rig) { rig.robot(robot).wire(device).slow(bytes_per_s); });
}
void SimHarness::drop(std::size_t robot, DeviceId device, double rate) {
  with_rig([=](SimRig& rig) { rig.robot(robot).wire(device).drop(rate); });
}
void SimHarness::dead(std::size_t robot, DeviceId laser, ScipHealth health) {
  with_rig([=](SimRig& rig) { rig.robot(robot).laser(laser).set_health(health, rig.now()); });
}
void SimHarness::reset(std::size_t robot, DeviceId device) {
  with_rig([=](SimRig& rig) {
    if (device == DeviceId::kBase) {
      rig.robot(robot).base().controller_reset(rig.now());
    } else {
      rig.robot(robot).laser(device).power_cycle(rig.now());
    }
  });
}
void SimHarness::stop_button(std::size_t robot, bool pressed) {
  with_rig([=](SimRig& rig) { rig.robot(robot).base().set_stop_button(pressed); });
}
void SimHarness::bumper(std::size_t robot, std::uint8_t front, std::uint8_t rear, double seconds) {
  with_rig([=](SimRig& rig) {
    rig.robot(robot).base().press_bumpers(front, rear, rig.now() + sim_seconds(seconds));
  });
}
void SimHarness::battery(std::size_t robot, double volts) {
  with_rig([=](SimRig& rig) { rig.robot(robot).base().set_battery(volts, 0.0, rig.now()); });
}
void SimHarness::clock_jump(std::size_t robot, DeviceId laser, double ms) {
  with_rig([=](SimRig& rig) { rig.robot(robot).laser(laser).jump_clock(ms); });
}
types::Result<MovableId> SimHarness::obstacle(std::size_t robot, double distance_m) {
  return with_rig([=](SimRig& rig) { return rig.simulation().add_box_ahead(robot, distance_m); });
}

}  // namespace topo::sim
