// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/grid/occupancy_grid.hpp"
#include "core/types/area_limits.hpp"
#include "core/types/keyframe_pose.hpp"
#include "core/types/scan.hpp"

// From the mapper's grid to the map that is planned on. Each step is a function of its own.
namespace topo::travel {

/// Unknown cells between free ones become free: at 20 m the beams of a scan are 9 cm apart, and the stripes
/// between them are no frontier. A cell is between when the nearest known cells on both sides, along a row, a
/// column or a diagonal and at most `reach` cells away, are free.
void close_gaps(grid::DenseMap& map, int reach);

/// The disc around a place where the robot stood is free, unless something was seen there: the scanner looks
/// over 270 degrees, and what is under the robot it never sees. The array's border stays unknown.
void free_disc(grid::DenseMap& map, const types::Vector2& centre, double radius_m);

/// Free cells in which a tenth of the keyframes saw something become occupied: glass lets most beams through,
/// and what is thin most beams miss. For driving a suspicion is enough, where the map itself wants more
/// evidence (grid::state_of).
void occupy_faint(grid::DenseMap& map, const grid::OccupancyGrid& grid);

/// What is only suspected where the robot itself stood is not there.
void free_trail(grid::DenseMap& map, const grid::OccupancyGrid& grid, const types::Vector2& centre,
                double radius_m);

/// Cells outside of the limits become occupied: no way leads there and nothing behind them is missed.
void apply_limits(grid::DenseMap& map, const types::AreaLimits& limits);

/// Where robots went: the robot's own keyframes, and those of its team-mates, a list each.
struct DrivenWays {
  std::span<const types::KeyframePose> own;
  std::span<const std::vector<types::KeyframePose>> mates;
};

/// All of it for a generation of the map. `route_radius_m` is what a route keeps free around the robot's
/// centre (grid::TravelRules::radius_m: the swing radius and some more).
grid::DenseMap prepare_map(const grid::OccupancyGrid& grid, const DrivenWays& ways,
                           const types::AreaLimits& limits, double route_radius_m);

/// End points of a scan within `range_max_m`, in map, that a neighbouring beam confirms: a lone point is a
/// mixed pixel as often as not.
std::vector<types::Vector2> confirmed_points(const types::Scan& scan, const types::Se2& T_map_laser,
                                             double range_max_m);

/// Takes points into a clearance map as obstacles, up to `reach_m` around each: clearance never grows.
void lower_clearance(const grid::DenseMap& map, std::span<const types::Vector2> obstacles, double reach_m,
                     std::vector<float>& clearance_m);

/// How far a trail stays open.
struct TrailRules {
  double open_m = 0.0;         ///< clearance that it has at least
  double above_m = 0.0;        ///< where it has as much without that
  double within_m = HUGE_VAL;  ///< of where the robot stands
};

/// Where the robot went it can go back, whatever else is thought to stand there: clearance as `rules` have it
/// on the lines between consecutive stations of its way that are near to one another. Where it stands, at
/// `here`, nothing changes: were that cell open, it would leave over open cells only, and not over whatever
/// is around it (grid::TravelRules::start_m).
void keep_trail_open(const grid::DenseMap& map, std::span<const types::KeyframePose> way,
                     grid::CellIndex here, const TrailRules& rules, std::vector<float>& clearance_m);

}  // namespace topo::travel
