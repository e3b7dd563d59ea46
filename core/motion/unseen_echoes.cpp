// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/motion/unseen_echoes.hpp"

#include <algorithm>
#include <cmath>

namespace topo::motion {
namespace {

using types::Vector2;

constexpr types::Duration kEchoAgeMax = std::chrono::milliseconds(150);  // later the robot is elsewhere
constexpr double kHalfCone_rad = 0.30;    // the beam's 12.5 degrees and what the pose is worth
constexpr double kLooksAhead_rad = 1.75;  // the laser's 135 degrees less the cone
constexpr double kBehindEcho_m = 0.30;    // a laser point up to here explains the echo
constexpr double kNearest_m = 0.15;       // nearer is ringing

bool is_usable(const types::SonarReading& echo, const Surroundings& around, double range_max_m) {
  const types::Duration age = around.now - echo.stamp;
  const double range_m = static_cast<double>(echo.range_m);
  return echo.stamp != types::Stamp{} && age >= types::Duration::zero() && age <= kEchoAgeMax &&
         range_m > kNearest_m && range_m < range_max_m;
}

/// Does the laser see anything in the echo's cone, up to the echo?
bool is_explained(const Vector2& p_sonar, double range_m) {
  const double distance_m = p_sonar.norm();
  return distance_m <= range_m + kBehindEcho_m && p_sonar.x() > 0.0 &&
         std::abs(std::atan2(p_sonar.y(), p_sonar.x())) <= kHalfCone_rad;
}

bool laser_explains(const Surroundings& around, const types::Se2& T_base_sonar, double range_m) {
  const types::Se2 T_sonar_laser = T_base_sonar.inverse() * around.T_base_laser;
  const types::Scan& scan = *around.front_scan;
  for (std::size_t i = 0; i < scan.beams; ++i) {
    if (!types::is_hit(scan.range_m[i])) continue;
    const double beam_m = static_cast<double>(scan.range_m[i]);
    if (beam_m > range_m + 1.0) continue;  // cannot be near the echo, whatever the lever between the two
    const double angle_rad = static_cast<double>(scan.angle_rad(i));
    const Vector2 p_laser(beam_m * std::cos(angle_rad), beam_m * std::sin(angle_rad));
    if (is_explained(T_sonar_laser * p_laser, range_m)) return true;
  }
  return false;
}

}  // namespace

std::size_t unseen_echoes(const Surroundings& around, double range_max_m, std::span<Vector2> out) {
  std::size_t count = 0;
  if (around.front_scan == nullptr) return count;
  const std::size_t known = std::min(around.sonar.size(), around.T_base_sonar.size());
  for (std::size_t i = 0; i < known && count < out.size(); ++i) {
    const types::Se2& T_base_sonar = around.T_base_sonar[i];
    if (std::abs(types::wrap_angle(T_base_sonar.theta_rad)) > kLooksAhead_rad) continue;
    if (!is_usable(around.sonar[i], around, range_max_m)) continue;
    const double range_m = static_cast<double>(around.sonar[i].range_m);
    if (laser_explains(around, T_base_sonar, range_m)) continue;
    out[count++] = T_base_sonar * Vector2(range_m, 0.0);
  }
  return count;
}

}  // namespace topo::motion
