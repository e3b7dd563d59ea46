// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/travel/params.hpp"

namespace topo::travel {

/// Turns the route's cells into a path that a robot can follow, with points PathParams::spacing_m apart. Cuts
/// corners of the grid where the straight line keeps the route's clearance (up to `preferred_m`), then rounds
/// them. In map; the centres of the first and last cell stay.
std::vector<types::Vector2> smooth_path(const grid::DenseMap& map, std::span<const float> clearance_m,
                                        std::span<const grid::CellIndex> route, double preferred_m,
                                        const PathParams& params);

/// Index of the point nearest to the robot among the first PathParams::near_points; 0 for an empty path.
std::size_t nearest_point(std::span<const types::Vector2> path, const types::Vector2& here,
                          const PathParams& params);

}  // namespace topo::travel
