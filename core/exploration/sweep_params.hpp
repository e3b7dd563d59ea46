// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace topo::exploration {

struct ViewpointParams {
  double reach_m = 4.0;    ///< from the robot to what is looked into
  double behind_m = 2.0;   ///< around a frontier; what is farther is not counted for it
  double wall_on_m = 0.6;  ///< so far beyond its seen ends a wall goes on: less than half of a wide door
};

struct FinalSweepParams {
  double opening_min_m = 0.3;  ///< what one can look through
  double gain_min_m2 = 0.3;    ///< exploration::Viewpoint::gain_m2
  /// All looks together, of what is known. What a sweep promises and what it shows have little to do with one
  /// another: from a twelfth of the promise, through slits in furniture, to all of it, in corners of rooms.
  double promise_min = 0.002;
  double time_share = 0.25;  ///< of the time without them: what sweeps take while nothing else is left
  double time_min_s = 60.0;  ///< or this, when that is less
  double reached_m = 0.2;    ///< half a metre beside it another part of what is behind the gap is seen
  ViewpointParams look;
};

}  // namespace topo::exploration
