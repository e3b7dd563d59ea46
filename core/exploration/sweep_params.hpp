// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>

#include "core/types/stamp.hpp"

// Parameters of the final sweep, developed on the sixteen public floor plans of doc/results.md.
namespace topo::exploration {

struct ViewpointParams {
  double reach_m = 4.0;    ///< from the robot to the frontier
  double behind_m = 2.0;   ///< around a frontier; cells farther away are not counted for it
  double wall_on_m = 0.6;  ///< a wall continues this far beyond its visible ends: less than half of a wide
                           ///< door
  std::size_t sources_max =
      8;                    ///< of the unknown cells beside a frontier, that are to be observed: bounds time
  int sources_min = 2;      ///< that a viewpoint sees: a single one is seen by chance
  double nearly_all = 0.7;  ///< share of the sources of the best cell that a viewpoint must see
  int rim_cells = 2;        ///< largest distance of an unknown cell beside a frontier from free space
};

struct FinalSweepParams {
  double opening_min_m = 0.3;  ///< least width of a gap to look through
  double gain_min_m2 = 0.3;    ///< least Viewpoint::gain_m2
  /// Least total gain of a sweep, as a share of the known area. Expected and actual gain of a sweep are
  /// hardly related: the actual one varies from a twelfth, through slits in furniture, to all, in corners of
  /// rooms.
  double promise_min = 0.002;
  double time_share = 0.25;  ///< limit of the time in sweeps with no other goal left, as a share of the time
                             ///< without them
  double time_min_s = 60.0;  ///< lower bound of that limit
  double reached_m = 0.2;    ///< half a metre beside a viewpoint another part behind the gap is visible
  double same_opening_m = 0.5;                            ///< centroids within this distance are one opening
  types::Duration still_true = std::chrono::seconds(30);  ///< a search for a viewpoint is repeated after this
  ViewpointParams look;
};

}  // namespace topo::exploration
