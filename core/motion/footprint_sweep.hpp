// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "core/motion/robot_limits.hpp"
#include "core/types/transform.hpp"

namespace topo::motion {

inline constexpr double kNever_s = HUGE_VAL;

/// When a footprint that moves at a constant twist, on a straight line or an arc, first touches a point that
/// is outside of it now. Seconds; 0 for a point inside; kNever_s when it does not within one full turn.
double contact_time_s(const types::Vector2& p_base, const types::Twist2& twist, const Footprint& footprint);

/// The same with a margin. A point already within the margin stops a motion towards it; a motion along it or
/// away from it has until the footprint itself touches, so that a robot beside a wall can leave.
double contact_time_with_margin_s(const types::Vector2& p_base, const types::Twist2& twist,
                                  const Footprint& footprint, double margin_m);

bool contains(const Footprint& footprint, const types::Vector2& p_base);

}  // namespace topo::motion
