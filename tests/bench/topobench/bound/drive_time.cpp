// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/motion/path_follower.hpp"
#include "tests/bench/topobench/bound/bound.hpp"

namespace topo::bench::bound {
namespace {

/// Of a distance from rest to rest, with a highest speed and two accelerations. Also of angles.
double ramp_time_s(double distance, double v_max, double speeding, double braking) {
  const double ramps = 0.5 * v_max * v_max * (1.0 / speeding + 1.0 / braking);
  if (distance >= ramps) return v_max / speeding + v_max / braking + (distance - ramps) / v_max;
  const double peak = std::sqrt(2.0 * distance / (1.0 / speeding + 1.0 / braking));
  return peak / speeding + peak / braking;
}

}  // namespace

double drive_time_s(const Way& way, const types::DriveLimits& limits) {
  const double sharp_rad = motion::FollowerTurnParams{}.begin_rad;
  double sum_s = 0.0, straight_m = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const sim::Vector2 leg = way[i] - way[i - 1];
    straight_m += leg.norm();
    double bend_rad = 0.0;
    if (i + 1 < way.size()) {
      const sim::Vector2 next = way[i + 1] - way[i];
      bend_rad = std::abs(types::wrap_angle(std::atan2(next.y(), next.x()) - std::atan2(leg.y(), leg.x())));
      if (bend_rad < sharp_rad) continue;
    }
    sum_s += ramp_time_s(straight_m, limits.v_max_mps, limits.acceleration_mps2, limits.deceleration_mps2);
    sum_s += ramp_time_s(bend_rad, limits.omega_max_radps, limits.angular_acceleration_radps2,
                         limits.angular_acceleration_radps2);
    straight_m = 0.0;
  }
  return sum_s;
}

}  // namespace topo::bench::bound
