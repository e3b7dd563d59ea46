// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/travel/driven_ways.hpp"
#include "core/travel/params.hpp"
#include "core/types/scan.hpp"
#include "core/types/se2.hpp"

namespace topo::travel {

/// Points of driven ways, in map, which the scan sees to be free: the beams beside each of them measure
/// something behind it. A person, or a mate that is not heard, stays in the map for a long time after having
/// stood on a way, since the map counts all that was ever seen; a robot that sees the way free may use it.
/// Elsewhere a beam that passes proves little: it passes through glass. Cost: the points near the robot.
std::vector<types::Vector2> seen_through(const types::Scan& scan, const types::Se2& T_map_laser,
                                         const DrivenWays& ways, const RouteMapParams& params);

}  // namespace topo::travel
