// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/control_step.hpp"

namespace topo::pipeline {

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
