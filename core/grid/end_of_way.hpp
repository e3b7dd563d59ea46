// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "core/grid/wavefront.hpp"

namespace topo::grid {

/// How far a route may lead where the robot cannot go yet.
struct WayLimits {
  double within_m = 0.0;  ///< the way stays within this box to each side of the goal
  double unseen_m = 0.0;  ///< length of the way through unknown cells, at most
};

/// End of the known route to `goal` when only unknown cells block the rest, as at a door that was seen
/// through while one of its jambs was not, or behind the shadow of a pillar. It is the cell at which the
/// robot can stay (TravelField::can_stay_at) and from which a chain of cells, side to side, leads to the goal
/// with the fewest unknown ones (of those without, the shortest), each cell free or unknown, with clearance
/// from occupied cells for the robot's disc; the goal itself when the robot can stay there. `clearance_m` is
/// that of the map alone (Boundary::kOccupiedOrUnknown). When it is sufficient all along the chain, something
/// other than unknown cells blocks the route and there is nothing to explore: nullopt. Also nullopt when
/// walls block the route, when the chain exceeds the limits, or when the goal is not free. Linear in the box,
/// which ends with the map.
std::optional<CellIndex> end_of_way(const DenseMap& map, std::span<const float> clearance_m,
                                    const TravelField& field, CellIndex goal, double radius_m,
                                    const WayLimits& limits);

}  // namespace topo::grid
