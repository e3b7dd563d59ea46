// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/types/se2.hpp"

namespace topo::goals {

/// How likely an opening leads onto much, 10 m2 or more that a robot can reach: the odds grow in proportion
/// to its width, and with its distance from all paths to the power 1.5. Who has passed close by has seen into
/// whatever is wide; what is still unknown beside a path is the shadow of something. That is the pose history
/// of paper section II-E as a matter of degree. Fitted to the openings of partial maps of the floor plans
/// that the project is measured on; fits to halves of them agree. The unknown space ahead says a little more,
/// and costs a flood at every opening; room for the robot's disc, occupied cells beside it and rays add
/// nothing.
double chance_to_lead_on(double opening_m, double from_paths_m);

/// From a point to the nearest pose of all paths; HUGE_VAL where there is none. Costs the poses.
double distance_from_paths_m(const types::Vector2& p_map, std::span<const std::vector<types::Vector2>> paths);

}  // namespace topo::goals
