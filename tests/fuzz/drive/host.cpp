// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/drive/host.hpp"

#include <algorithm>
#include <utility>

namespace topo::fuzz {
namespace {

/// The two threads run beside each other.
constexpr types::Duration kSideBySide = std::chrono::milliseconds(10);

pioneer::ConnectionConfig base_config() {
  pioneer::ConnectionConfig config;
  config.sonar = false;
  return config;
}

hokuyo::ConnectionConfig front_config() {
  hokuyo::ConnectionConfig config;
  config.name = "front";
  return config;
}

pipeline::ControlSetup control_setup() {
  pipeline::ControlSetup setup;
  setup.limits.footprint.swing_radius_m = types::kP3dx.swing_radius_m;
  setup.T_base_laser.x_m = 0.021;
  return setup;
}

}  // namespace

Host::Host(World& world)
    : base_(base_config(), std::make_unique<HostileConnector>(base_port_)),
      front_(front_config(), std::make_unique<HostileConnector>(scan_port_)),
      setup_(control_setup()),
      scan_(std::make_unique<types::Scan>()),
      incoming_scan_(std::make_unique<types::Scan>()) {
  base_port_.line = &world.base_line;
  scan_port_.line = &world.scan_line;
  base_port_.now = scan_port_.now = world.now();
  for (HostilePort* port : {&base_port_, &scan_port_})
    port->advance = [&world](types::Stamp until) { world.advance(until); };
  base_port_.on_write = [&world](std::string_view bytes) { world.to_base(bytes); };
  scan_port_.on_write = [&world](std::string_view bytes) { world.to_scanner(bytes); };
}

void Host::period() {
  const types::Stamp due = std::max(base_port_.now, scan_port_.now) + types::kBasePeriod;
  for (types::Stamp until = base_port_.now + kSideBySide; until < due; until += kSideBySide) serve(until);
  serve(due);
  decide();
}

void Host::sleep(types::Duration duration) {
  for (HostilePort* port : {&base_port_, &scan_port_}) {
    port->now += duration;
    port->advance(port->now);
  }
  decide();
}

void Host::serve(types::Stamp until) {
  while (base_port_.now < until) {
    if (base_.step(incoming_, until - base_port_.now) != pioneer::StepOutcome::kState) continue;
    state_ = incoming_;
    has_state_ = true;
  }
  while (scan_port_.now < until) {
    if (front_.step(*incoming_scan_, until - scan_port_.now) != hokuyo::StepOutcome::kScan) continue;
    std::swap(scan_, incoming_scan_);
    has_scan_ = true;
  }
}

void Host::decide() {
  pipeline::ControlInput in;
  in.now = base_port_.now;
  in.estop = estop;
  in.estop_cleared = std::exchange(estop_cleared, false);
  teleop_ = {in.now, wish};
  in.teleop = &teleop_;
  const bool base_ready = base_.health() == pioneer::Health::kReady;
  in.state = base_ready && has_state_ ? &state_ : nullptr;
  in.front = has_scan_ ? scan_.get() : nullptr;
  in.base_released = base_.releases() != std::exchange(releases_, base_.releases());
  if (const auto& info = base_.info(); info) {
    in.firmware_watchdog = std::chrono::milliseconds(info->watchdog_ms);
    in.firmware_deceleration_mps2 = info->deceleration_top_mps2;
  }
  output_ = pipeline::control_step(control_, setup_, in);
  base_.set_silence(output_.command.silence);
  sent_ = base_ready;
  if (base_ready) (void)base_.command(output_.command);
}

}  // namespace topo::fuzz
