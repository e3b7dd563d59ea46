// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "core/types/se2.hpp"
#include "core/types/stamp.hpp"

namespace topo::types {

/// A model by its catalogue, from the centre of rotation. The one place of these numbers.
struct ModelSize {
  double front_m = 0.0, rear_m = 0.0, width_m = 0.0;
  double swing_radius_m = 0.0;  ///< of the circle that it needs to turn on the spot
  double v_max_mps = 0.0, omega_max_radps = 0.0;
};
inline constexpr ModelSize kP3dx{0.210, 0.301, 0.425,
                                 0.267, 1.2,   300 * kDegree_rad};  // PROTOCOLS section 6.2
inline constexpr ModelSize kP3at{0.313, 0.313, 0.505, 0.340, 0.7, 140 * kDegree_rad};

/// Between two decisions of the base thread.
inline constexpr Duration kBasePeriod = std::chrono::milliseconds(50);

/// The robot's outline from above, relative to its centre of rotation: a rectangle intersected with the
/// circle that the robot needs to turn on the spot (PROTOCOLS section 6.2: a P3-DX has no corners beyond
/// 0.267 m, although its rectangle has).
struct Footprint {
  double front_m = kP3dx.front_m;
  double rear_m = kP3dx.rear_m;
  double half_width_m = kP3dx.width_m / 2.0;
  double swing_radius_m = HUGE_VAL;  ///< infinity: unknown, the rectangle alone
};

/// Radius of the smallest circle about the centre of rotation that holds the outline.
inline double reach_m(const Footprint& f) {
  return std::min(f.swing_radius_m, std::hypot(std::max(f.front_m, f.rear_m), f.half_width_m));
}

/// The outline enlarged by `by_m` on every side.
inline Footprint grown(const Footprint& f, double by_m) {
  return {f.front_m + by_m, f.rear_m + by_m, f.half_width_m + by_m, f.swing_radius_m + by_m};
}

/// How fast the base may drive, and how fast it may change that. The one place of the defaults.
struct DriveLimits {
  double v_max_mps = 0.7;
  double omega_max_radps = 1.4;
  double acceleration_mps2 = 0.3;
  double deceleration_mps2 = 0.5;
  double angular_acceleration_radps2 = 1.7;

  /// These five alone, of anything that has them.
  void take_limits(const DriveLimits& from) { *this = from; }
};

/// Motion limits of one robot: the minimum over configuration, model and firmware.
struct RobotLimits : DriveLimits {
  Footprint footprint;
  double margin_m = 0.05;       ///< kept free around the footprint
  double turn_margin_m = 0.03;  ///< the same for a turn on the spot, without path errors
  /// Additional curvature that the encoders do not measure when one wheel slips for 0.6 of its travel on a
  /// track of 0.36 m. The robot must be able to brake on such an arc as well.
  double slip_curvature_per_m = 1.7;
  double v_beside_mps = 0.12;  ///< slow enough to drive beside an obstacle despite wheel slip
  /// Displacement of the centre per radian of a turn on the spot with the same wheel slip.
  double slip_aside_m_per_rad = 0.05;
  double omega_beside_radps = 0.2;  ///< slow enough to turn beside an obstacle despite wheel slip
  bool allow_reverse = false;       ///< the rear is blind; setting this asserts a free route
  double v_reverse_max_mps = 0.1;
  types::Duration request_age_max = std::chrono::milliseconds(300);
  types::Duration status_age_max = std::chrono::milliseconds(300);
  types::Duration reaction = std::chrono::milliseconds(100);  ///< from a scan's arrival to the wheels
};

/// False when a value is out of range or not finite (swing_radius_m may be infinite); all motion is blocked
/// then.
bool is_valid(const RobotLimits& limits);

}  // namespace topo::types
