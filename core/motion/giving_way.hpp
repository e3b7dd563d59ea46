// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/perception/moving_obstacle.hpp"
#include "core/types/robot_limits.hpp"
#include "core/types/transform.hpp"

namespace topo::motion {

/// When the robot drives for `alive_s` at a twist and then brakes: does it stand before what moves touches it
/// (with `margin_m` between, and more the farther ahead that is)? What is nearer than that already counts
/// when it gets nearer still. Who stands has done what it can.
bool stands_in_time(const types::Twist2& twist, std::span<const perception::MovingObstacle> moving,
                    double alive_s, double margin_m, const types::RobotLimits& limits);

/// The largest part of a twist, in twentieths, at which it stands in time and is not in the way: it is clear
/// of what moves for another second, standing or by going on. 0 when there is none.
double giving_way_scale(const types::Twist2& twist, std::span<const perception::MovingObstacle> moving,
                        double alive_s, const types::RobotLimits& limits);

}  // namespace topo::motion
