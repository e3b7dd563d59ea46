// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "core/grid/wavefront.hpp"

namespace topo::grid {

/// Where the known way to `goal` ends when only what is unknown closes it: a door that was seen through, and
/// one jamb of it not yet. The reachable cell from which the fewest free cells, side to side, lead to the
/// goal, all of them far enough from what is occupied for the robot's disc; the goal itself when it is
/// reachable. `clearance_m` is that of the map alone (Boundary::kOccupiedOrUnknown): where it has room enough
/// something else closes the way, and nothing is to be learned there. Nothing then, nor when walls close it,
/// nor when it is longer than `within_m` to a side of the goal. Costs the box of that size.
std::optional<CellIndex> end_of_way(const DenseMap& map, std::span<const float> clearance_m,
                                    const TravelField& field, CellIndex goal, double radius_m,
                                    double within_m);

}  // namespace topo::grid
