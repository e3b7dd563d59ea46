// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/compass/compass.hpp"
#include "core/types/geometry.hpp"
#include "core/walls/wall_params.hpp"

namespace topo::analysis {

/// When points have a direction of their own. The values are choices: with them none of the sixteen public
/// floor plans has a wing, and of the maps of Bormann et al. those two whose pictures show one
/// (doc/results.md).
struct WingParams {
  std::size_t wings_max = 3;
  double near_m = 0.15;    ///< points nearer to a wall belong to it: a partition is seen from both sides
  double share_min = 0.1;  ///< least share of a wing's points, of all
  double confidence_min = 0.03;  ///< least Compass::confidence: clutter has a direction by chance
  double apart_rad = 0.0873;     ///< 5 degrees: nearer directions are the same, of walls that were not found
  double walls_min_m = 15.0;     ///< least length of a wing's walls, all together
};

struct Wings {
  std::vector<double> directions_rad;  ///< in [0, pi/2), as they were found
  std::vector<types::Segment> walls;   ///< of all wings, in map
};

/// The directions that the points away from the walls have in common: the compass again, without what it has
/// explained. `occupied`: the points of the building's compass; `wall_points`: those of its walls;
/// `direction_rad`, `walls`: what was found of them. The order of the points does not matter.
Wings skew_wings(std::span<const types::Vector2> occupied, std::span<const types::Vector2> wall_points,
                 double direction_rad, std::span<const types::Segment> walls,
                 const compass::CompassParams& compass, const walls::WallParams& wall_params,
                 const WingParams& params);

}  // namespace topo::analysis
