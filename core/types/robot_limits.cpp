// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/types/robot_limits.hpp"

#include <cmath>

namespace topo::types {
namespace {

bool is_positive(double value) { return std::isfinite(value) && value > 0.0; }

}  // namespace

bool is_valid(const RobotLimits& l) {
  const Footprint& f = l.footprint;
  return is_positive(l.v_max_mps) && is_positive(l.omega_max_radps) && is_positive(l.acceleration_mps2) &&
         is_positive(l.deceleration_mps2) && is_positive(l.angular_acceleration_radps2) &&
         is_positive(f.front_m) && is_positive(f.rear_m) && is_positive(f.half_width_m) &&
         f.swing_radius_m >= f.half_width_m && std::isfinite(l.slip_curvature_per_m) &&
         l.slip_curvature_per_m >= 0.0 && is_positive(l.v_beside_mps) &&
         is_positive(l.slip_aside_m_per_rad) && is_positive(l.omega_beside_radps) &&
         std::isfinite(l.turn_margin_m) && l.turn_margin_m >= 0.0 && std::isfinite(l.margin_m) &&
         l.margin_m >= 0.0 && is_positive(l.v_reverse_max_mps) && l.reaction >= types::Duration::zero();
}

}  // namespace topo::types
