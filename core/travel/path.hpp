// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"

namespace topo::travel {

inline constexpr double kPathSpacing_m = 0.1;  ///< approximate spacing of a path's points
/// The first 3 m of a path. A robot drives less between two uses of its path.
inline constexpr auto kNearPoints = static_cast<std::size_t>(3.0 / kPathSpacing_m);

/// Turns the route's cells into a path that a robot can follow, with points kPathSpacing_m apart. Cuts
/// corners of the grid where the straight line keeps the route's clearance (up to `preferred_m`), then rounds
/// them. In map; the centres of the first and last cell stay.
std::vector<types::Vector2> smooth_path(const grid::DenseMap& map, std::span<const float> clearance_m,
                                        std::span<const grid::CellIndex> route, double preferred_m);

/// Index of the point nearest to the robot among the first kNearPoints; 0 for an empty path.
std::size_t nearest_point(std::span<const types::Vector2> path, const types::Vector2& here);

}  // namespace topo::travel
