// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/control_evidence.hpp"

#include <algorithm>

namespace topo::pipeline {

types::RobotLimits limits_now(const ControlSetup& setup, const ControlInput& in) {
  types::RobotLimits limits = setup.limits;
  if (in.firmware_deceleration_mps2 > 0.0)
    limits.deceleration_mps2 = std::min(limits.deceleration_mps2, in.firmware_deceleration_mps2);
  return limits;
}

plausibility::Evidence evidence(const ControlSetup& setup, const ControlInput& in,
                                const types::RobotLimits& limits, const Granted& last) {
  plausibility::Evidence evidence{
      .now = in.now,
      .commanded = last.given,
      .base = in.state != nullptr && motion::is_finite(*in.state) ? in.state : nullptr,
      .front = in.front,
      .matched = in.matched,
      .T_base_laser = setup.T_base_laser,
      .limits = {},
      .model = setup.model,
      .cleared = in.estop_cleared,
      .base_released = in.base_released,
      .motors_wanted = last.motors};
  evidence.limits.take_limits(limits);
  return evidence;
}

}  // namespace topo::pipeline
