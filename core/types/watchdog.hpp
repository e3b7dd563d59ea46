// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/types/stamp.hpp"

namespace topo::types {

/// What the base's firmware stops the robot after at the latest when this computer falls silent.
inline constexpr std::chrono::milliseconds kWatchdogMax{2000};

/// Whether a robot with such a watchdog may be driven. Zero: it is off, or not reported.
[[nodiscard]] constexpr bool is_watchdog_safe(Duration watchdog) {
  return watchdog > Duration::zero() && watchdog <= kWatchdogMax;
}

}  // namespace topo::types
