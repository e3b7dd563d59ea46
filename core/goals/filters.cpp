// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/filters.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/places/segmentation/box_counts.hpp"

namespace topo::goals {
namespace {

using grid::CellState;
using places::CompassFrame;

/// Outward direction of a side, in the compass frame.
types::Vector2 outward(Side side) {
  switch (side) {
    case Side::kEast:
      return {1.0, 0.0};
    case Side::kNorth:
      return {0.0, 1.0};
    case Side::kWest:
      return {-1.0, 0.0};
    case Side::kSouth:
      return {0.0, -1.0};
    case Side::kNone:
      break;
  }
  return {0.0, 0.0};
}

}  // namespace

bool faces_another_place(const GoalInput& input, std::uint16_t place, Side side, const GoalParams& params) {
  const double reach_m = params.internal_reach_m;
  const types::Vector2 middle = side_midpoint(input.places, place, side);
  const types::Vector2 out = CompassFrame(input.places.compass_rad).to_map(outward(side));
  for (double d = -reach_m; d <= reach_m; d += input.map.resolution_m) {
    const grid::CellIndex cell = input.map.cell_at(middle + d * out);
    if (!input.map.contains(cell)) continue;
    const std::uint16_t label = input.places.labels[input.map.index(cell)];
    if (label != 0 && label != place) return true;
  }
  return false;
}

double distance_from_paths_m(const types::Vector2& p_map,
                             std::span<const std::vector<types::Vector2>> paths) {
  double nearest_m2 = HUGE_VAL;
  for (const std::vector<types::Vector2>& path : paths) {
    for (const types::Vector2& p : path) nearest_m2 = std::min(nearest_m2, (p - p_map).squaredNorm());
  }
  return std::sqrt(nearest_m2);
}

bool is_visited(const Goal& goal, std::span<const std::vector<types::Vector2>> visited,
                const GoalParams& params) {
  const bool wide = goal.opening_m >= params.wide_ratio * params.opening_min_m;
  double travelled_m = 0.0;
  for (const std::vector<types::Vector2>& way : visited) {
    bool was_near = false;
    for (std::size_t k = 0; k < way.size(); ++k) {
      const bool near = (way[k] - goal.p_map).norm() < params.visited_radius_m;
      if (near && !wide) return true;
      if (near && was_near) travelled_m += (way[k] - way[k - 1]).norm();
      was_near = near;
    }
  }
  return travelled_m >= params.wide_travel_ratio * params.visited_radius_m;
}

}  // namespace topo::goals
