// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/grid/occupancy_grid.hpp"
#include "core/types/keyframe_pose.hpp"
#include "core/types/stamp.hpp"
#include "core/types/transform.hpp"
#include "core/walls/wall_store.hpp"

namespace topo::pipeline {

/// One generation of the map: occupancy, walls, poses and the correction of the odometry are published
/// together, so that no reader mixes two generations. Immutable once published. Created and destroyed by the
/// mapping thread only; readers pin it in a sync::SnapshotCell. Creation costs a comparison of the tiles that
/// changed since the previous snapshot and O(keyframes) for the poses, independent of the map's size.
struct MapSnapshot {
  std::uint64_t revision = 0;
  std::uint64_t changed_cells = 0;  ///< cells of the grid that changed their state, summed from snapshot to
                                    ///< snapshot
  types::Stamp stamp{};             ///< of the last scan used
  types::Transform2<types::Map, types::Odom> T_map_odom;
  types::Transform2<types::Map, types::Base> T_map_base;  ///< at `stamp`
  grid::OccupancyGrid grid;
  walls::WallStore walls;
  std::vector<types::KeyframePose> keyframes;                ///< the robot's own
  std::vector<std::vector<types::KeyframePose>> mates = {};  ///< of the team-mates in this map, a list each
};

}  // namespace topo::pipeline
