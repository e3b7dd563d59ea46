// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/types/stamp.hpp"

namespace topo::types {

/// Below either the robot goes home.
struct BatteryLimits {
  double home_v = 0.0;
  double charge_home = 0.0;  ///< 0..1, of the state of charge
};

/// Starting motors pull the voltage down for a moment: low is a battery that has been so for this long.
inline constexpr Duration kBatteryLowFor = std::chrono::seconds(10);

/// Whether one reading is below a limit. 0 V or less, and a negative state of charge, are not reported and
/// below nothing.
[[nodiscard]] constexpr bool is_battery_low(float battery_v, float state_of_charge,
                                            const BatteryLimits& limits) {
  const bool low_v = battery_v > 0.0F && static_cast<double>(battery_v) < limits.home_v;
  const bool low_charge =
      state_of_charge >= 0.0F && static_cast<double>(state_of_charge) < limits.charge_home;
  return low_v || low_charge;
}

}  // namespace topo::types
