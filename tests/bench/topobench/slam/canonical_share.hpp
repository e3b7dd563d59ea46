// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/grid/occupancy_grid.hpp"
#include "core/slam/mapper.hpp"

namespace topo::bench {

/// Of the known cells of the canonical map of what the mapper's robot saw and found, how many `grid` has in
/// another state (DESIGN "SLAM": at most 0.001 of them). Costs a solution of the graph and a map.
double unlike_canonical_share(const slam::Mapper& mapper, const grid::OccupancyGrid& grid);

}  // namespace topo::bench
