// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/perception/unseen_echoes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/types/beam_directions.hpp"

namespace topo::perception {
namespace {

using types::Vector2;

bool is_usable(const types::SonarReading& echo, const Surroundings& around, const UnseenEchoParams& params) {
  const types::Duration age = around.now - echo.stamp;
  const double range_m = static_cast<double>(echo.range_m);
  return echo.stamp != types::Stamp{} && age >= types::Duration::zero() && age <= params.age_max &&
         range_m > params.range_min_m && range_m < params.range_max_m;
}

/// Region in which a laser point explains the echo, in the sonar's frame: the beam's cone up to
/// UnseenEchoParams::behind_m behind the echo.
class Cone {
 public:
  Cone(double range_m, const UnseenEchoParams& params)
      : reach_m_(range_m + params.behind_m), tan_(std::tan(params.half_cone_rad)) {}
  [[nodiscard]] bool has(const Vector2& p_sonar) const {
    return p_sonar.x() > 0.0 && std::abs(p_sonar.y()) <= tan_ * p_sonar.x() &&
           p_sonar.squaredNorm() <= reach_m_ * reach_m_;
  }
  /// Corners of a triangle around the cone, the tip first.
  [[nodiscard]] std::array<Vector2, 3> corners() const {
    return {Vector2{0.0, 0.0}, {reach_m_, tan_ * reach_m_}, {reach_m_, -tan_ * reach_m_}};
  }
  /// True when a point is in that triangle, to within a tolerance.
  [[nodiscard]] bool is_around(const Vector2& p_sonar) const {
    constexpr double kNearly_m = 1e-3;  // numerical: no beam that meets the cone is left out
    return p_sonar.x() > -kNearly_m && p_sonar.x() < reach_m_ + kNearly_m &&
           std::abs(p_sonar.y()) < tan_ * p_sonar.x() + 2.0 * kNearly_m;
  }

 private:
  double reach_m_, tan_;
};

struct Beams {
  std::size_t begin = 0, end = 0;
};

double bearing_rad(const Vector2& p) { return std::atan2(p.y(), p.x()); }

/// The beams that can meet the cone: those between the bearings of its corners. All beams when the laser is
/// within the cone, or when the bearings straddle the scan's seam.
Beams beams_towards(const Cone& cone, const types::Se2& T_sonar_laser, const types::Scan& scan) {
  const Beams all{0, scan.beams};
  const double step_rad = static_cast<double>(scan.geometry.angle_increment_rad);
  if (!(step_rad > 0.0) || cone.is_around(T_sonar_laser.translation())) return all;
  const types::Se2 T_laser_sonar = T_sonar_laser.inverse();
  const std::array<Vector2, 3> corners = cone.corners();
  const double first_rad = static_cast<double>(scan.geometry.angle_min_rad);
  const double middle_rad = first_rad + 0.5 * step_rad * (scan.beams - 1);
  const double centre_rad =
      bearing_rad(T_laser_sonar * Vector2((corners[0] + corners[1] + corners[2]) / 3.0));
  double low_rad = 0.0, high_rad = 0.0;
  for (const Vector2& corner : corners) {
    const double off_rad = types::wrap_angle(bearing_rad(T_laser_sonar * corner) - centre_rad);
    low_rad = std::min(low_rad, off_rad);
    high_rad = std::max(high_rad, off_rad);
  }
  const double from_middle_rad = types::wrap_angle(centre_rad - middle_rad);
  if (from_middle_rad + low_rad < -std::numbers::pi || from_middle_rad + high_rad > std::numbers::pi)
    return all;
  const auto beam = [&](double off_rad) {
    const double i = (middle_rad + from_middle_rad + off_rad - first_rad) / step_rad;
    return std::clamp(i, 0.0, static_cast<double>(scan.beams));
  };
  return {static_cast<std::size_t>(std::floor(beam(low_rad - step_rad))),
          static_cast<std::size_t>(std::ceil(beam(high_rad + step_rad)))};
}

bool laser_explains(const Surroundings& around, const types::Se2& T_base_sonar, double range_m,
                    const UnseenEchoParams& params) {
  const types::Se2 T_sonar_laser = T_base_sonar.inverse() * around.T_base_laser;
  const types::Scan& scan = *around.front_scan;
  const Cone cone(range_m, params);
  const Beams beams = beams_towards(cone, T_sonar_laser, scan);
  types::BeamDirections direction(scan.geometry, T_sonar_laser.theta_rad, beams.begin);
  for (std::size_t i = beams.begin; i < beams.end; ++i, direction.advance()) {
    if (!types::is_hit(scan.range_m[i])) continue;
    const double beam_m = static_cast<double>(scan.range_m[i]);
    if (cone.has(T_sonar_laser.translation() + beam_m * direction.now())) return true;
  }
  return false;
}

}  // namespace

std::size_t unseen_echoes(const Surroundings& around, const UnseenEchoParams& params,
                          std::span<Vector2> out) {
  std::size_t count = 0;
  if (around.front_scan == nullptr) return count;
  const std::size_t known = std::min(around.sonar.size(), around.T_base_sonar.size());
  for (std::size_t i = 0; i < known && count < out.size(); ++i) {
    const types::Se2& T_base_sonar = around.T_base_sonar[i];
    if (std::abs(types::wrap_angle(T_base_sonar.theta_rad)) > params.looks_ahead_rad) continue;
    if (!is_usable(around.sonar[i], around, params)) continue;
    const double range_m = static_cast<double>(around.sonar[i].range_m);
    if (laser_explains(around, T_base_sonar, range_m, params)) continue;
    out[count++] = T_base_sonar * Vector2(range_m, 0.0);
  }
  return count;
}

}  // namespace topo::perception
