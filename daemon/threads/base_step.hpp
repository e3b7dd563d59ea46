// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/motion/velocity_gate.hpp"
#include "core/types/base_state.hpp"
#include "core/types/scan.hpp"
#include "daemon/threads/hand_overs.hpp"

namespace topo::daemon {

/// What stays the same while the daemon runs.
struct BaseSetup {
  motion::RobotLimits limits;
  types::Se2 T_base_laser;  ///< front scanner
};

/// What the base thread decides from, once a period. Pointers: the newest of each, null when there is none.
struct BaseInput {
  types::Stamp now{};
  bool estop = false;
  bool estop_cleared = false;  ///< since the last period
  const DriveCommand* drive = nullptr;
  const types::BaseState* state = nullptr;
  const types::Scan* front = nullptr;
  std::span<const types::Se2> T_base_sonar;
  types::Duration firmware_watchdog{};
};

/// What is remembered from one period to the next.
struct BaseMemory {
  motion::GateState gate;
  bool armed = false;  ///< motors are enabled from the first drive command until an e-stop
};

struct BaseDecision {
  types::BaseCommand command;
  motion::GateReason reason = motion::GateReason::kStaleStatus;
  bool wanted = false;
  double free_distance_m = 0.0;
};

/// What the operator wants, through the velocity gate, which has the last word. Without a wish younger than
/// limits.request_age_max (the dead man) the wish is to stand. Pure.
BaseDecision base_step(BaseMemory& memory, const BaseSetup& setup, const BaseInput& input);

}  // namespace topo::daemon
