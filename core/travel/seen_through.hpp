// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/travel/driven_ways.hpp"
#include "core/travel/params.hpp"
#include "core/types/scan.hpp"
#include "core/types/se2.hpp"

namespace topo::travel {

/// Occupied cells of a map near the robot that its scan sees to be free, as their centres in map: every beam
/// through such a cell measures something behind it. A person, or a mate that is not heard, stays in the map
/// for a long time after having stood somewhere, since the map counts all that was ever seen; a robot that
/// sees the place free may use it. Only cells of what stands free and is no larger than a person or a robot,
/// and cells on driven ways: elsewhere a beam that passes proves little, since it passes through glass. Cost:
/// the cells near the robot.
std::vector<types::Vector2> seen_through(const types::Scan& scan, const types::Se2& T_map_laser,
                                         const grid::DenseMap& map, const DrivenWays& ways,
                                         const RouteMapParams& params);

}  // namespace topo::travel
