// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/control_step.hpp"

namespace topo::pipeline {

struct ControlState::Impl {
  motion::GateState gate;
  bool armed = false;  ///< motors are enabled from the first wish to move until an e-stop
};

ControlState::ControlState() : impl_(std::make_unique<Impl>()) {}
ControlState::~ControlState() = default;

ControlOutput control_step(ControlState& state, const ControlSetup& setup, const ControlInput& input) {
  ControlState::Impl& memory = *state.impl_;
  const bool wanted = input.teleop != nullptr && input.teleop->stamp != types::Stamp{} &&
                      input.now - input.teleop->stamp <= setup.limits.request_age_max;
  memory.armed = memory.armed || wanted;
  motion::GateInput gate_input;
  gate_input.now = input.now;
  gate_input.request.stamp = wanted ? input.teleop->stamp : input.now;
  if (wanted) gate_input.request.twist = input.teleop->twist;
  gate_input.request.enable_motors = memory.armed;
  gate_input.base = input.state;
  gate_input.front_scan = input.front;
  gate_input.T_base_laser = setup.T_base_laser;
  gate_input.T_base_sonar = input.T_base_sonar;
  gate_input.estop_pressed = input.estop;
  gate_input.estop_cleared = input.estop_cleared;
  gate_input.firmware_watchdog = input.firmware_watchdog;
  gate_input.limits = setup.limits;
  const motion::GateOutput out = motion::gate(memory.gate, gate_input);
  if (memory.gate.estop_latched) memory.armed = false;
  ControlOutput result;
  result.command = out.command;
  result.report.stamp = input.now;
  result.report.mode = wanted ? ControlMode::kTeleop : ControlMode::kStanding;
  result.report.reason = out.reason;
  result.report.estop_latched = memory.gate.estop_latched;
  result.report.commanded = out.command.twist;
  result.report.free_distance_m = out.free_distance_m;
  return result;
}

std::string_view to_text(ControlMode mode) {
  switch (mode) {
    case ControlMode::kStanding:
      return "standing";
    case ControlMode::kTeleop:
      return "driven by hand";
    case ControlMode::kFollowing:
      return "following";
    case ControlMode::kArrived:
      return "arrived";
    case ControlMode::kWaiting:
      return "waiting";
    case ControlMode::kRecovering:
      return "recovering";
    case ControlMode::kStuck:
      return "stuck";
  }
  return "unknown";
}

}  // namespace topo::pipeline
