// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/goals/essential_goals.hpp"
#include "core/types/se2.hpp"

namespace topo::goals {

/// The probability that an opening leads onto a large area: 10 m2 or more that a robot can reach. The odds
/// are proportional to the opening's width and to its distance from all paths (plus an offset, up to a limit)
/// to a power. A robot that has passed close by has seen into every wide opening; space beside a path
/// that is still unknown is the shadow of an object. This is the pose history of paper section II-E as a
/// continuous measure. The unknown space ahead adds a little information, but costs a
/// flood fill at every opening; clearance for the robot's disc, occupied cells beside the opening and rays
/// add none.
double chance_to_lead_on(double opening_m, double from_paths_m, const ChanceParams& params);

/// Distance from a point to the nearest pose of all paths; HUGE_VAL without poses. Linear in the poses.
double distance_from_paths_m(const types::Vector2& p_map, std::span<const std::vector<types::Vector2>> paths);

}  // namespace topo::goals
