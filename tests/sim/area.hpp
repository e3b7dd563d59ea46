// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/sim/raster.hpp"
#include "tests/sim/world.hpp"

namespace topo::sim {

/// Distance of every cell's centre to the nearest cell that is 0 (all cells outside the raster are 0),
/// metres, exact on the cell grid (Felzenszwalb and Huttenlocher 2012).
std::vector<float> clearance_m(const Raster& free);

/// The free cell with the largest clearance (the first from below of several).
Se2 roomiest_place(const Raster& free);

/// 1 where a disc of this radius fits and can be reached from `start` over such positions.
Raster reachable_poses(const Raster& free, const Vector2& start, double radius_m);

/// The part of the building that is visible to a robot from all reachable poses: cells of World::structure()
/// on a line of sight at height z_m from a reachable pose. The reference for a finished map.
struct ReachableArea {
  Raster poses;    ///< reachable_poses
  Raster visible;  ///< 1 = free and visible from one of the poses
};
ReachableArea reachable_area(const World& world, const Vector2& start, double radius_m, double z_m = 0.3,
                             double range_max_m = 30.0);

}  // namespace topo::sim
