// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/goals/essential_goals.hpp"
#include "core/goals/goal.hpp"

namespace topo::goals {

/// A frontier of a place.
struct Opening {
  std::uint16_t place = 0;   ///< label in the place map, at its middle
  Side side = Side::kNone;   ///< of that place's box, nearest to its middle
  std::uint32_t middle = 0;  ///< the cell nearest to the centroid of the cells
  double width_m = 0.0;      ///< greater extent of its cells plus one cell
  std::vector<std::uint32_t> cells;
};

/// The openings at least `opening_min_m` wide, by place and side.
///
/// Departure from paper section II-E, which uses the midpoints of the four sides of a place's box: on a side
/// of thirty metres the midpoint carries little information about a doorway near its end, and a frontier
/// through a door need not lie at any midpoint. The candidates of a side are therefore located at its actual
/// openings.
std::vector<Opening> find_openings(const GoalInput& input, const GoalParams& params);

/// The side of the place's box that a point is nearest to.
Side nearest_side(const places::PlaceMap& places, std::uint16_t place, const types::Vector2& p_map);

/// Middle of a side of the place's box, in map.
types::Vector2 side_midpoint(const places::PlaceMap& places, std::uint16_t place, Side side);

}  // namespace topo::goals
