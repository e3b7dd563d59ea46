// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/robot_info.hpp"

#include <algorithm>
#include <cmath>

#include "core/types/watchdog.hpp"

namespace topo::pioneer {
namespace {

/// The lower of the table's and the firmware's limit; 0 from the firmware means unknown.
double lower(double table, double firmware) { return firmware > 0.0 ? std::min(table, firmware) : table; }

int at_least_one(double wanted, int firmware_top) {
  const double value = lower(std::isfinite(wanted) ? wanted : 0.0, firmware_top);
  return std::clamp(static_cast<int>(std::lround(std::clamp(value, 1.0, 32767.0))), 1, 32767);
}

void add_config(RobotInfo& info, const ConfigPacket& config) {
  info.firmware = config.firmware;
  info.serial_number = config.serial_number;
  info.watchdog_ms = config.watchdog_ms;
  constexpr int kCycleMin_ms = 20;  // a shorter cycle is not valid for a Pioneer
  if (config.sip_cycle_ms >= kCycleMin_ms) info.sip_cycle_ms = config.sip_cycle_ms;
  info.v_top_mps = lower(info.v_top_mps, config.velocity_top_mmps * 1e-3);
  info.omega_top_radps = lower(info.omega_top_radps, config.rot_velocity_top_degps * types::kDegree_rad);
  info.deceleration_top_mps2 = config.acceleration_top_mmps2 * 1e-3;
  info.low_battery_v = config.low_battery_decivolt * 0.1;
}

}  // namespace

RobotInfo make_robot_info(const std::string& name, const std::string& subclass, const RobotModel& model,
                          const ConfigAnswer& config, int given_watchdog_ms) {
  RobotInfo info;
  info.name = name;
  info.subclass = subclass;
  info.assumed = assumption(subclass, model);
  info.v_top_mps = model.size.v_max_mps;
  info.omega_top_radps = model.size.omega_max_radps;
  info.track_m = 2e-3 / model.radps_per_mmps;
  info.swing_radius_m = model.size.swing_radius_m;
  info.length_front_m = model.size.front_m;
  info.length_rear_m = model.size.rear_m;
  info.width_m = model.size.width_m;
  static_assert(RobotModel::kSonars <= types::BaseState::kMaxSonars);
  std::copy(model.T_base_sonar.begin(), model.T_base_sonar.end(), info.T_base_sonar.begin());
  info.sonars = RobotModel::kSonars;
  info.sonar_range_max_m = kSonarRangeMax_m;
  if (config.packet) add_config(info, *config.packet);
  if (info.watchdog_ms > 0 || given_watchdog_ms <= 0) return info;
  info.watchdog_ms = given_watchdog_ms;
  info.watchdog = WatchdogSource::kGiven;
  return info;
}

std::string watchdog_fault(const ConfigAnswer& config, int given_watchdog_ms) {
  const std::string within = "1 to " + std::to_string(types::kWatchdogMax.count()) + " ms";
  const int told_ms = config.packet ? config.packet->watchdog_ms : 0;
  if (told_ms > 0 && types::is_watchdog_safe(std::chrono::milliseconds(told_ms))) return {};
  if (told_ms > 0)
    return "the firmware's watchdog takes " + std::to_string(told_ms) +
           " ms; driving is refused until WatchDog in its FLASH is " + within;
  if (given_watchdog_ms > 0) return {};
  const std::string cure = "; driving is refused until base.watchdog_ms gives it, " + within +
                           (config.packet ? " (WatchDog in FLASH)" : ", to be measured");
  if (config.packet) return "the firmware's watchdog is off or not reported (WatchDog 0)" + cure;
  if (config.damaged > 0)
    return "its CONFIG packet came damaged (" + std::to_string(config.damaged) +
           " times), so its watchdog is unknown" + cure;
  return "the robot sent no CONFIG packet, so its watchdog is unknown" + cure;
}

DriveLimits drive_limits(const ConnectionConfig& wanted, const RobotInfo& info,
                         const std::optional<ConfigPacket>& config) {
  const ConfigPacket top = config.value_or(ConfigPacket{});
  const auto bounded = [](double value, double limit) {
    return std::isfinite(value) ? std::clamp(value, 0.0, limit) : 0.0;
  };
  return {.v_mps = bounded(wanted.v_max_mps, info.v_top_mps),
          .omega_radps = bounded(wanted.omega_max_radps, info.omega_top_radps),
          .acceleration_mmps2 = at_least_one(wanted.acceleration_mps2 * 1e3, top.acceleration_top_mmps2),
          .deceleration_mmps2 = at_least_one(wanted.deceleration_mps2 * 1e3, top.acceleration_top_mmps2),
          .angular_acceleration_degps2 = at_least_one(wanted.angular_acceleration_radps2 / types::kDegree_rad,
                                                      top.rot_acceleration_top_degps2),
          .wheels = wanted.wheels,
          .model_track_m = info.track_m};
}

}  // namespace topo::pioneer
