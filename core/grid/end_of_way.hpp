// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "core/grid/wavefront.hpp"

namespace topo::grid {

/// End of the known route to `goal` when only unknown cells block the rest, as at a door that was seen
/// through while one of its jambs was not. It is the cell at which the robot can stay
/// (TravelField::can_stay_at) and from which the shortest chain of free cells, side to side, leads to the
/// goal, each cell with clearance from occupied cells for the robot's disc; the goal itself when the robot
/// can stay there. `clearance_m` is that of the map alone (Boundary::kOccupiedOrUnknown). When it is
/// sufficient all along the chain, something other than unknown cells blocks the route and there is nothing
/// to explore: nullopt. Also nullopt when walls block the route or when the chain leaves the box of
/// `within_m` to each side of the goal. Linear in that box.
std::optional<CellIndex> end_of_way(const DenseMap& map, std::span<const float> clearance_m,
                                    const TravelField& field, CellIndex goal, double radius_m,
                                    double within_m);

}  // namespace topo::grid
