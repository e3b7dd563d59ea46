// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/occupancy_grid.hpp"
#include "core/slam/keyframe.hpp"

namespace topo::slam {

/// The same counts of one square of the map.
struct RevisitRegion {
  static constexpr double kSide_m = 5.0;  ///< a doubled corridor fills a few of them
  types::Vector2 centre;
  std::uint64_t points = 0, within = 0;
};

/// How far a map agrees with itself where the robot came again: what needs no truth.
struct RevisitShare {
  std::uint64_t points = 0;  ///< ends of beams, of all keyframes, on surfaces that another visit looked at
  std::uint64_t within =
      0;  ///< of these, within the tolerance of the centre of an occupied cell that another visit hit
  [[nodiscard]] double share() const {
    return points > 0 ? static_cast<double>(within) / static_cast<double>(points) : 0.0;
  }
  std::vector<RevisitRegion> regions{};  ///< those with points, by row and column
};

/// Which stretches of the path are of other visits: Visits. Another visit looked at the surface that a point
/// lies on when it hit an occupied cell within the tolerance, or when it contradicts the point:
/// BeamFan::contradicts. So a wall that stands twice counts against the map, but also a door that somebody
/// opened, a person, and glass. What no other visit looked at does not count: the other face of a wall, what
/// stands behind something, and what a beam only ran along. In a team each robot's way is taken by itself,
/// in whatever order their keyframes come.
RevisitShare revisit_share(std::span<const KeyframePtr> keyframes, std::span<const types::Se2> poses,
                           const grid::OccupancyGrid& map, double tolerance_m = 0.10);

}  // namespace topo::slam
