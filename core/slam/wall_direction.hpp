// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/slam/cloud.hpp"

namespace topo::slam {

struct WallDirectionParams {
  double near_rad = 0.0524;      ///< 3 degrees: normals that differ less are of one direction
  std::size_t surfels_min = 30;  ///< on lines in the direction; 1.2 m of wall
  double share_min = 0.4;        ///< of the surfels on lines; of normals at random it is 0.07
};

/// A direction that repeats each quarter turn: walls of a building are parallel or at right angles.
struct CommonDirection {
  double angle_rad = 0.0;  ///< mean of those near it
  std::size_t near = 0;    ///< how many these are
};

/// The direction around the three degrees that hold most of the angles, as the mean of what is within
/// `near_rad` of it; ties go to the least. O(angles).
[[nodiscard]] CommonDirection common_direction(std::span<const double> angles_rad, double near_rad);

/// The direction of a keyframe's walls in base_link, modulo a quarter turn: the compass of paper section II-A
/// for what one scan sees. Empty where its surfels have no common direction.
[[nodiscard]] std::optional<double> wall_direction(std::span<const Surfel> surfels,
                                                   const WallDirectionParams& params = {});

}  // namespace topo::slam
