// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/battery_text.hpp"

#include <fmt/format.h>

namespace topo::daemon {

std::string battery_text(const types::BaseState& state) {
  std::string text =
      state.battery_v > 0.0F ? fmt::format("{:.1f} V", state.battery_v) : "voltage not reported";
  if (state.state_of_charge >= 0.0F) text += fmt::format(", {:.0f} %", 100.0F * state.state_of_charge);
  return text;
}

std::string battery_limits_text(const types::BatteryLimits& limits) {
  std::string text = fmt::format("below {:.1f} V (exploration.battery_home_v)", limits.home_v);
  if (limits.charge_home > 0.0)
    text += fmt::format(" or {:.0f} % (exploration.charge_home)", 100.0 * limits.charge_home);
  return text + " the robot goes home";
}

}  // namespace topo::daemon
