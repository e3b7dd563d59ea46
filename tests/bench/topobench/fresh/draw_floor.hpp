// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "tests/bench/topobench/fresh/floor_plan.hpp"
#include "tests/sim/raster.hpp"

namespace topo::bench::fresh {

/// The plan moved so that all of it has coordinates above 0, with a margin of solid ground.
FloorPlan moved_to_origin(FloorPlan plan);

/// The plan in cells: 1 where the floor is free. The raster begins at the origin.
sim::Raster draw_floor(const FloorPlan& plan);

/// What of the raster is the floor of one space.
struct SpaceCells {
  std::size_t wing = 0, space = 0;
  std::vector<std::size_t> cells;  ///< of the raster, that are free
};
std::vector<SpaceCells> cells_of_spaces(const FloorPlan& plan, const sim::Raster& free);

}  // namespace topo::bench::fresh
