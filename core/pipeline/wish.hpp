// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/motion/backing.hpp"
#include "core/motion/velocity_gate.hpp"
#include "core/pipeline/control_step.hpp"

namespace topo::pipeline {

/// The motion that one period requests from the gate.
struct Wish {
  ControlMode mode = ControlMode::kStanding;
  types::Twist2 twist;
  bool moving = false;  ///< the motors are required
  motion::Backing backing = motion::Backing::kNone;
};

/// Result of the last period's wish.
struct Granted {
  motion::GateReason reason = motion::GateReason::kFree;
  types::Twist2 wished, given;
  bool motors = false;  ///< were to be on
};

/// After an e-stop, a plan must have stood or have another goal before a plan moves the robot.
struct Hold {
  bool held = false;
  std::uint64_t goal = 0;
};

/// Number of touches of the outline, and the position of the last.
struct Touches {
  bool touching = false;  ///< in the last period
  std::uint32_t count = 0;
  types::Vector2 at_odom{0.0, 0.0};
};

}  // namespace topo::pipeline
