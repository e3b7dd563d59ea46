// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "core/exploration/sweep_params.hpp"
#include "core/goals/frontiers.hpp"
#include "core/types/geometry.hpp"

namespace topo::exploration {

/// A place from which to look into a gap that is too narrow, or too far behind furniture, to be driven to.
struct Viewpoint {
  grid::CellIndex from;   ///< where the robot stands
  grid::CellIndex sight;  ///< in the middle of what is unknown in one direction from there
  double gain_m2 = 0.0;   ///< unknown space that may come in sight; much less does as a rule
};

/// From where a frontier is best looked into: of the cells that the field reaches and that see unknown space
/// beside the frontier over free cells, the one nearest to the frontier's centroid of those that see nearly
/// the most. `walls`, in map: what is unknown behind them, and behind where they go on, counts for nothing.
/// Nothing when hardly any of it is in sight from anywhere. Does not depend on the order of the walls. Costs
/// at most 1700 rays, and the cells around the frontier.
std::optional<Viewpoint> find_viewpoint(const grid::DenseMap& map, const goals::Frontier& frontier,
                                        const grid::TravelField& field, std::span<const types::Segment> walls,
                                        const ViewpointParams& params = {});

}  // namespace topo::exploration
