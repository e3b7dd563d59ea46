// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/types/transform.hpp"

namespace topo::pioneer {

/// VEL and RVEL in wire units. Whole mm/s and deg/s: a rotation below 0.5 deg/s becomes 0. VEL2 would resolve
/// 20 mm/s per wheel, which is coarser in both.
struct Setpoints {
  int v_mmps = 0;
  int omega_degps = 0;
  friend bool operator==(const Setpoints&, const Setpoints&) = default;
};

/// Clamped to +-v_limit and +-omega_limit; a twist that is not finite is a stop.
Setpoints quantise(const types::Twist2& twist, double v_limit_mps, double omega_limit_radps);

}  // namespace topo::pioneer
