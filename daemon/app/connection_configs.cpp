// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/connection_configs.hpp"

namespace topo::daemon {
namespace {

hokuyo::ConnectionConfig connection_config(const std::string& name, const ScannerConfig& scanner) {
  hokuyo::ConnectionConfig config;
  config.name = name;
  config.serial_number = scanner.serial_number;
  config.intensity = scanner.intensity;
  config.skip_scans = scanner.skip_scans;
  config.stamp_offset_s = scanner.stamp_offset_s;
  config.masks = scanner.masks;
  return config;
}

}  // namespace

/// The masks count from straight ahead, and the angles of a scan from the zero beam.
hokuyo::ConnectionConfig front_connection_config(const ScannerConfig& front) {
  hokuyo::ConnectionConfig config = connection_config("front", front);
  config.mirrored = is_upside_down(front);
  for (types::Sector& mask : config.masks.all)
    mask = {mask.from_rad - front.yaw_rad, mask.to_rad - front.yaw_rad};
  return config;
}

/// They count from straight up to the robot's left; a mirrored scanner is turned round by
/// walls::CoronalMount.
hokuyo::ConnectionConfig coronal_connection_config(const ScannerConfig& coronal) {
  hokuyo::ConnectionConfig config = connection_config("coronal", coronal);
  for (types::Sector& mask : config.masks.all) {
    const types::Sector seen = coronal.mirrored ? types::Sector{-mask.to_rad, -mask.from_rad} : mask;
    mask = {seen.from_rad - coronal.roll_rad, seen.to_rad - coronal.roll_rad};
  }
  return config;
}

pioneer::ConnectionConfig base_connection_config(const Configuration& configuration) {
  const BaseConfig& base = configuration.base;
  pioneer::ConnectionConfig config;
  config.expected_chassis = configuration.robot.model == RobotModel::kP3at ? "p3at" : "p3dx";
  config.family = base.family;
  config.watchdog_ms = base.watchdog_ms;
  config.expected_name = base.name;
  config.expected_serial_number = base.serial_number;
  config.take_limits(base);
  config.sonar = base.sonar;
  config.gyro = base.gyro;
  config.wheels = base.wheels;
  config.status_delay = types::from_seconds(base.status_delay_s);
  return config;
}

}  // namespace topo::daemon
