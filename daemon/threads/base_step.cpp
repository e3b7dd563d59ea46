// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/threads/base_step.hpp"

namespace topo::daemon {

BaseDecision base_step(BaseMemory& memory, const BaseSetup& setup, const BaseInput& input) {
  const bool wanted = input.drive != nullptr && input.drive->stamp != types::Stamp{} &&
                      input.now - input.drive->stamp <= setup.limits.request_age_max;
  memory.armed = memory.armed || wanted;
  motion::GateInput gate_input;
  gate_input.now = input.now;
  gate_input.request.stamp = wanted ? input.drive->stamp : input.now;
  if (wanted) gate_input.request.twist = input.drive->twist;
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
  // After an e-stop the operator has to ask anew before the motors are enabled again.
  if (memory.gate.estop_latched) memory.armed = false;
  return {out.command, out.reason, wanted, out.free_distance_m};
}

}  // namespace topo::daemon
