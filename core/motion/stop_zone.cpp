// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/motion/stop_zone.hpp"

#include <algorithm>
#include <cmath>

#include "core/motion/footprint_sweep.hpp"

namespace topo::motion {
namespace {

using types::Scan;
using types::Vector2;

constexpr std::size_t kBridgedBeams = 3;
constexpr types::Duration kSonarAgeMax = std::chrono::milliseconds(500);  // a sweep takes 320 ms
constexpr float kLeastRange_m = 0.02F;

double bearing_rad(const Scan& scan, const types::Se2& T_base_laser, std::size_t beam) {
  return types::wrap_angle(static_cast<double>(scan.angle_rad(beam)) + T_base_laser.theta_rad);
}

bool is_forward(const Scan& scan, const types::Se2& T_base_laser, std::size_t beam) {
  return std::abs(bearing_rad(scan, T_base_laser, beam)) <= kForwardSector_rad;
}

bool is_valid_range(float range_m) { return types::is_hit(range_m) || range_m == types::kNoReturn; }

/// One past the last invalid beam from `beam` on.
std::size_t gap_end(const Scan& scan, std::size_t beam) {
  while (beam < scan.beams && std::isnan(scan.range_m[beam])) ++beam;
  return beam;
}

/// What an invalid beam in the gap [begin, end) is taken for.
float gap_range_m(const Scan& scan, std::size_t begin, std::size_t end) {
  const float least_m = std::max(scan.geometry.range_min_m, kLeastRange_m);
  if (end - begin > kBridgedBeams || begin == 0 || end == scan.beams) return least_m;
  const float nearer_m = std::min(scan.range_m[begin - 1], scan.range_m[end]);
  return nearer_m < least_m ? least_m : nearer_m;
}

/// Calls visit(point in base, in forward sector) for whatever the scan takes for an obstacle.
template <class Visit>
void for_each_obstacle(const Scan& scan, const types::Se2& T_base_laser, Visit visit) {
  const float least_m = std::max(scan.geometry.range_min_m, kLeastRange_m);
  const auto point = [&](std::size_t beam, float range_m) {
    const double angle_rad = static_cast<double>(scan.angle_rad(beam)), range = static_cast<double>(range_m);
    return T_base_laser * Vector2{range * std::cos(angle_rad), range * std::sin(angle_rad)};
  };
  std::size_t gap_begin = 0, gap_until = 0;
  for (std::size_t i = 0; i < scan.beams; ++i) {
    const float range_m = scan.range_m[i];
    const bool forward = is_forward(scan, T_base_laser, i);
    if (types::is_hit(range_m)) {
      visit(point(i, range_m), forward);
      continue;
    }
    if (range_m == types::kNoReturn || !forward) continue;
    if (range_m == types::kTooNear) {
      visit(point(i, least_m), true);
      continue;
    }
    if (i >= gap_until) {
      gap_begin = i;
      while (gap_begin > 0 && std::isnan(scan.range_m[gap_begin - 1])) --gap_begin;
      gap_until = gap_end(scan, i);
    }
    const float taken_m = gap_range_m(scan, gap_begin, gap_until);
    if (taken_m != types::kNoReturn) visit(point(i, taken_m), true);
  }
}

double scan_free_time_s(const types::Twist2& twist, const RobotLimits& limits, const Surroundings& around) {
  double free_s = kNever_s;
  for_each_obstacle(*around.front_scan, around.T_base_laser, [&](const Vector2& p, bool forward) {
    // Beside and behind, a hit within the outline is the robot itself.
    if (!forward && contains(limits.footprint, p)) return;
    free_s = std::min(free_s, contact_time_with_margin_s(p, twist, limits.footprint, limits.margin_m));
  });
  return free_s;
}

bool is_fresh_echo(const types::SonarReading& reading, const Surroundings& around) {
  const types::Duration age = around.now - reading.stamp;
  return reading.stamp != types::Stamp{} && age >= types::Duration::zero() && age <= kSonarAgeMax &&
         std::isfinite(reading.range_m) && static_cast<double>(reading.range_m) < around.sonar_range_max_m;
}

double sonar_free_time_s(const types::Twist2& twist, const RobotLimits& limits, const Surroundings& around) {
  double free_s = kNever_s;
  for (std::size_t i = 0; i < std::min(around.sonar.size(), around.T_base_sonar.size()); ++i) {
    if (!is_fresh_echo(around.sonar[i], around)) continue;
    const Vector2 p = around.T_base_sonar[i] * Vector2{static_cast<double>(around.sonar[i].range_m), 0.0};
    free_s = std::min(free_s, contact_time_with_margin_s(p, twist, limits.footprint, limits.margin_m));
  }
  return free_s;
}

}  // namespace

double forward_valid_fraction(const Scan& scan, const types::Se2& T_base_laser) {
  std::size_t forward = 0, valid = 0;
  for (std::size_t i = 0; i < scan.beams; ++i) {
    if (!is_forward(scan, T_base_laser, i)) continue;
    ++forward;
    if (is_valid_range(scan.range_m[i])) ++valid;
  }
  return forward == 0 ? 0.0 : static_cast<double>(valid) / static_cast<double>(forward);
}

double free_time_s(const types::Twist2& twist, const RobotLimits& limits, const Surroundings& around) {
  if (!std::isfinite(twist.v_mps) || !std::isfinite(twist.omega_radps)) return 0.0;
  double free_s = sonar_free_time_s(twist, limits, around);
  if (around.front_scan != nullptr) free_s = std::min(free_s, scan_free_time_s(twist, limits, around));
  return free_s;
}

double free_distance_m(const types::Twist2& twist, double free_time_s) {
  if (free_time_s == 0.0) return 0.0;
  return twist.v_mps == 0.0 ? kNever_s : std::abs(twist.v_mps) * free_time_s;
}

}  // namespace topo::motion
