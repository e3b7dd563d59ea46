// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/analysis/analysis.hpp"
#include "core/goals/goal.hpp"
#include "core/slam/doubt/revisit.hpp"
#include "core/types/se2.hpp"
#include "daemon/mapfile/picture.hpp"

namespace topo::daemon {

/// Picture of the analysed map for users: the map in grey levels, its places in translucent colours, the
/// skeleton in grey, walls in red, the trajectory in blue (a ring at its beginning, a disc at its end), the
/// open goals as green discs with their numbers (from 1, in the given order), rejected candidates as small
/// orange squares, regions where the map is doubted as frames in magenta. One pixel per cell, several for a
/// small map; y points up. Cropped to the known part of the map; one grey pixel when nothing is known.
[[nodiscard]] Picture overview_of(const analysis::Analysis& analysis, std::span<const types::Se2> trajectory,
                                  std::span<const goals::Goal> open_goals,
                                  std::span<const slam::RevisitRegion> doubted = {});

}  // namespace topo::daemon
