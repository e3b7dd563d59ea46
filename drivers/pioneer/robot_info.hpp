// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "drivers/pioneer/config_packet.hpp"
#include "drivers/pioneer/connection.hpp"
#include "drivers/pioneer/robot_models.hpp"
#include "drivers/pioneer/setpoints.hpp"

namespace topo::pioneer {

/// Table and CONFIG packet together; without the packet the watchdog is 0, which means: unknown.
RobotInfo make_robot_info(const std::string& name, const RobotModel& model,
                          const std::optional<ConfigPacket>& config);

/// Empty when the firmware stops the robot within two seconds of its host's death; otherwise why driving is
/// refused, and what to do. No command sets the watchdog: it is a parameter in FLASH.
std::string watchdog_fault(const std::optional<ConfigPacket>& config);

/// What is asked for, within what the robot can do. All positive.
struct DriveLimits {
  double v_mps = 0.0;
  double omega_radps = 0.0;
  int acceleration_mmps2 = 0, deceleration_mmps2 = 0;
  int angular_acceleration_degps2 = 0;
};
DriveLimits drive_limits(const ConnectionConfig& wanted, const RobotInfo& info,
                         const std::optional<ConfigPacket>& config);

}  // namespace topo::pioneer
