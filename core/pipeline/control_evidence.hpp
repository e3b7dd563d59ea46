// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/pipeline/control_step.hpp"
#include "core/pipeline/wish.hpp"

namespace topo::pipeline {

/// The limits of this period: the robot brakes with what configuration and firmware both allow.
[[nodiscard]] types::RobotLimits limits_now(const ControlSetup& setup, const ControlInput& in);

/// What core/plausibility compares; a base whose status is not finite counts as absent.
[[nodiscard]] plausibility::Evidence evidence(const ControlSetup& setup, const ControlInput& in,
                                              const types::RobotLimits& limits, const Granted& last);

}  // namespace topo::pipeline
