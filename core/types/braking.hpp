// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace topo::types {

/// Way in m, with the sign of the speed, that a robot goes until it stands when it brakes evenly.
[[nodiscard]] inline double braking_m(double v_mps, double deceleration_mps2) {
  return v_mps * std::abs(v_mps) / (2.0 * deceleration_mps2);
}

}  // namespace topo::types
