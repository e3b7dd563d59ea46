// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/setpoints.hpp"

#include <algorithm>
#include <cmath>

#include "core/types/se2.hpp"

namespace topo::pioneer {
namespace {

/// Rounds towards zero at the limit, so that rounding never exceeds it.
int to_units(double value, double limit, double units) {
  const double bound = std::floor(std::max(limit, 0.0) * units + 1e-9);
  return static_cast<int>(std::clamp(std::round(value * units), -bound, bound));
}

}  // namespace

Setpoints quantise(const types::Twist2& twist, double v_limit_mps, double omega_limit_radps) {
  if (!std::isfinite(twist.v_mps) || !std::isfinite(twist.omega_radps)) return {};
  return {to_units(twist.v_mps, v_limit_mps, 1000.0),
          to_units(twist.omega_radps, omega_limit_radps, 1.0 / types::kDegree_rad)};
}

}  // namespace topo::pioneer
