// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <memory>
#include <numbers>

#include "core/types/scan.hpp"
#include "core/types/se2.hpp"

namespace topo::motion {

/// A UTM-30LX scan that sees nothing: 270 degrees, 1081 beams, 40 Hz.
inline std::unique_ptr<types::Scan> empty_scan(types::Stamp stamp) {
  constexpr float kQuarterDegree = std::numbers::pi_v<float> / 720.0F;
  auto scan = std::make_unique<types::Scan>();
  scan->first_beam = stamp;
  scan->arrival = stamp;
  scan->beams = 1081;
  scan->geometry = {.angle_min_rad = -540.0F * kQuarterDegree,
                    .angle_increment_rad = kQuarterDegree,
                    .time_increment_s = 0.025F / 1440.0F,
                    .period_s = 0.025F,
                    .range_min_m = 0.1F,
                    .range_max_m = 30.0F};
  scan->range_m.fill(types::kNoReturn);
  return scan;
}

/// A straight wall across the way, `distance_m` ahead of the laser, two metres wide.
inline void put_wall_ahead(types::Scan& scan, double distance_m) {
  for (std::size_t i = 0; i < scan.beams; ++i) {
    const double angle_rad = static_cast<double>(scan.angle_rad(i));
    if (std::abs(angle_rad) < 1.5 && std::abs(distance_m * std::tan(angle_rad)) <= 1.0)
      scan.range_m[i] = static_cast<float>(distance_m / std::cos(angle_rad));
  }
}

constexpr std::size_t kAhead = 540;  ///< the beam along x

}  // namespace topo::motion
