// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "core/exploration/sweep_params.hpp"
#include "core/goals/frontiers.hpp"
#include "core/types/geometry.hpp"

namespace topo::exploration {

/// A viewpoint for a gap that is too narrow, or too far behind furniture, to drive to.
struct Viewpoint {
  grid::CellIndex from;   ///< position of the robot
  grid::CellIndex sight;  ///< middle of the longest unknown stretch in one direction from there
  double gain_m2 = 0.0;   ///< unknown space that may become visible; usually much less does
};

/// The best viewpoint for a frontier: among reachable cells that see unknown space beside the frontier over
/// free cells, and nearly the largest number of such cells, the one nearest to the frontier's centroid.
/// `walls`, in map: unknown space behind them, and behind their continuation, does not count. Nothing when
/// hardly any unknown space is visible from anywhere. Does not depend on the order of the walls. Costs at
/// most 180 rays for each of sources_max cells and 270 more, and the cells around the frontier.
std::optional<Viewpoint> find_viewpoint(const grid::DenseMap& map, const goals::Frontier& frontier,
                                        const grid::TravelField& field, std::span<const types::Segment> walls,
                                        const ViewpointParams& params = {});

}  // namespace topo::exploration
