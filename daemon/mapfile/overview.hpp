// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/analysis/analysis.hpp"
#include "core/goals/goal.hpp"
#include "core/types/se2.hpp"
#include "daemon/mapfile/picture.hpp"

namespace topo::daemon {

/// What the robot makes of its map, for a person: the map in grey levels, its places in translucent colours,
/// the skeleton in grey, walls in red, the trajectory in blue (a ring where it began, a disc where it is),
/// the goals that may be chosen as green discs with their numbers (from 1, in the order given), rejected
/// candidates as small orange squares. One pixel a cell, several for a small map; turned so that y is up.
/// Cut to the known part of the map; one grey pixel when nothing is known.
[[nodiscard]] Picture overview_of(const analysis::Analysis& analysis, std::span<const types::Se2> trajectory,
                                  std::span<const goals::Goal> open_goals);

}  // namespace topo::daemon
