// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/types/stamp.hpp"

namespace topo::types {

/// The robot returns home when either value falls below its limit.
struct BatteryLimits {
  double home_v = 0.0;
  double charge_home = 0.0;  ///< 0..1, of the state of charge
};

/// A battery counts as low after this long below a limit: starting motors pull the voltage down for a moment.
inline constexpr Duration kBatteryLowFor = std::chrono::seconds(10);

/// True when one reading is below a limit. A voltage of 0 V or less and a negative state of charge count as
/// not reported and are never low.
[[nodiscard]] constexpr bool is_battery_low(float battery_v, float state_of_charge,
                                            const BatteryLimits& limits) {
  const bool low_v = battery_v > 0.0F && static_cast<double>(battery_v) < limits.home_v;
  const bool low_charge =
      state_of_charge >= 0.0F && static_cast<double>(state_of_charge) < limits.charge_home;
  return low_v || low_charge;
}

}  // namespace topo::types
