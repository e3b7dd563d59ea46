// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"

namespace topo::travel {

inline constexpr double kPathSpacing_m = 0.1;  ///< of a path's points, about
/// Farther than these 3 m along its path no robot gets between two looks at it.
inline constexpr auto kNearPoints = static_cast<std::size_t>(3.0 / kPathSpacing_m);

/// The route's cells as a path that a robot can follow, points kPathSpacing_m apart: corners of the grid are
/// cut where the straight line keeps the clearance that the route had (as far as `preferred_m`), then
/// rounded. In map; the first and last cell's centres stay.
std::vector<types::Vector2> smooth_path(const grid::DenseMap& map, std::span<const float> clearance_m,
                                        std::span<const grid::CellIndex> route, double preferred_m);

/// Index of the point among the first kNearPoints that is nearest to the robot; 0 for an empty one.
std::size_t nearest_point(std::span<const types::Vector2> path, const types::Vector2& here);

}  // namespace topo::travel
