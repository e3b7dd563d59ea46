// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace topo::team {

/// No source is recorded for the values that name none.
struct RightOfWayParams {
  double near_m = 3.0;  ///< team-mates further away are ignored
  double room_m = 0.9;  ///< between the centres of two robots that pass each other: two discs plus a margin
  /// Sum of: two swing radii (0.53 m), both robots braking from 0.65 m/s (0.72), and closing at twice that
  /// speed for a planning period and the delays of the scanner and the base (0.65).
  double beside_m = 2.0;
  double abreast_m = 0.3;         ///< a smaller offset ahead or behind counts as abreast
  double speed_mps = 0.7;         ///< assumed of a team-mate since its last message
  std::int32_t stride_cells = 4;  ///< between the cells that are checked, along each axis
  double detour_ratio = 2.0;  ///< greatest cost of the way aside, with inflation, over the distance searched
};

}  // namespace topo::team
