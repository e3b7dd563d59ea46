// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "core/grid/occupancy_grid.hpp"
#include "core/slam/keyframe.hpp"

namespace topo::bench {

/// How far a map agrees with itself where the robot came again: what needs no truth.
struct RevisitShare {
  std::uint64_t points = 0;  ///< ends of beams, of all keyframes, at places that another visit saw
  std::uint64_t within =
      0;  ///< of these, within the tolerance of the centre of an occupied cell that another visit hit
  [[nodiscard]] double share() const {
    return points > 0 ? static_cast<double>(within) / static_cast<double>(points) : 0.0;
  }
};

/// The path is cut into stretches of 2.5 m. Two stretches belong to different visits when the way between
/// them is at least 15 m and at least twice as long as they are apart: a straight corridor seen from both
/// ends in passing is one visit, coming back is another. Another visit saw a place when one of its beams
/// ended within 0.5 m of it or went through it; so a wall that stands twice counts against the map, but also
/// a door that somebody opened.
RevisitShare revisit_share(std::span<const slam::KeyframePtr> keyframes, std::span<const types::Se2> poses,
                           const grid::OccupancyGrid& map, double tolerance_m = 0.10);

}  // namespace topo::bench
