// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/types/stamp.hpp"

namespace topo::types {

/// Longest watchdog timeout after which the base's firmware stops the robot when the host is silent.
inline constexpr std::chrono::milliseconds kWatchdogMax{2000};

/// True when a robot with this watchdog timeout may be driven. Zero: the watchdog is off or not reported.
[[nodiscard]] constexpr bool is_watchdog_safe(Duration watchdog) {
  return watchdog > Duration::zero() && watchdog <= kWatchdogMax;
}

}  // namespace topo::types
