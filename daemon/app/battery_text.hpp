// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/types/base_state.hpp"
#include "core/types/battery.hpp"

namespace topo::daemon {

/// The battery's state as reported by the base: "12.6 V, 45 %".
[[nodiscard]] std::string battery_text(const types::BaseState& state);

/// The conditions that send the robot home, with the keys of the configuration.
[[nodiscard]] std::string battery_limits_text(const types::BatteryLimits& limits);

}  // namespace topo::daemon
