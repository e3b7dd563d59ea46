// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/motion/params.hpp"
#include "core/perception/moving_obstacle.hpp"
#include "core/types/robot_limits.hpp"
#include "core/types/transform.hpp"

namespace topo::motion {

/// True when a robot that drives for `alive_s` at a twist and then brakes stands before a moving obstacle
/// touches it, with `margin_m` between them, and more the farther ahead in time. An obstacle that is already
/// nearer counts only when it comes nearer still. Contact after the robot has come to rest does not count.
bool stands_in_time(const types::Twist2& twist, std::span<const perception::MovingObstacle> moving,
                    double alive_s, double margin_m, const types::RobotLimits& limits,
                    const GivingWayParams& params);

/// The largest scale of a twist, in twentieths, at which the robot stands in time and stays clear of moving
/// obstacles for GivingWayParams::clear_for_s, standing or driving on. 0 when there is none.
double giving_way_scale(const types::Twist2& twist, std::span<const perception::MovingObstacle> moving,
                        double alive_s, const types::RobotLimits& limits, const GivingWayParams& params);

}  // namespace topo::motion
