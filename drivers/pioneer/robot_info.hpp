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

/// Combines table and CONFIG packet. Without the packet the watchdog is the configured one, 0 when there is
/// none: unknown.
RobotInfo make_robot_info(const std::string& name, const std::string& subclass, const RobotModel& model,
                          const ConfigAnswer& config, int given_watchdog_ms);

/// Empty when the firmware stops the robot within two seconds after loss of its host, by its own word or,
/// where it gives none, by configuration (which is then measured); otherwise the reason why driving is
/// refused, and the cure. No command sets the watchdog: it is a parameter in FLASH.
std::string watchdog_fault(const ConfigAnswer& config, int given_watchdog_ms);

/// The configured limits, bounded by the robot's limits. All positive.
struct DriveLimits {
  double v_mps = 0.0;
  double omega_radps = 0.0;
  int acceleration_mmps2 = 0, deceleration_mmps2 = 0;
  int angular_acceleration_degps2 = 0;
  types::WheelCalibration wheels;  ///< by which setpoints differ from what is wanted
  double model_track_m = 0.357;    ///< with which the firmware reckons
};
DriveLimits drive_limits(const ConnectionConfig& wanted, const RobotInfo& info,
                         const std::optional<ConfigPacket>& config);

}  // namespace topo::pioneer
