// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/sim/raster.hpp"
#include "tests/sim/world.hpp"

namespace topo::sim {

/// Distance of every cell's centre to the nearest cell that is 0 (beyond the raster all is 0), metres, exact
/// on the cell grid (Felzenszwalb and Huttenlocher 2012).
std::vector<float> clearance_m(const Raster& free);

/// The free cell with the most room around it (of several the first from below).
Se2 roomiest_place(const Raster& free);

/// 1 where a disc of the radius can stand and can get to from `start` without leaving such places.
Raster reachable_poses(const Raster& free, const Vector2& start, double radius_m);

/// What a robot can see of the building when it has been everywhere it can reach: cells of World::structure()
/// on a line of sight at height z_m from a reachable pose. The measure of a finished map.
struct ReachableArea {
  Raster poses;    ///< reachable_poses
  Raster visible;  ///< 1 = free and seen from one of them
};
ReachableArea reachable_area(const World& world, const Vector2& start, double radius_m, double z_m = 0.3,
                             double range_max_m = 30.0);

}  // namespace topo::sim
