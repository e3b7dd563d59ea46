// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/grid/occupancy_grid.hpp"
#include "core/travel/driven_ways.hpp"
#include "core/travel/params.hpp"
#include "core/types/area_limits.hpp"
#include "core/types/keyframe_pose.hpp"
#include "core/types/scan.hpp"

// Turns the mapper's grid into the map for planning, one function for each step.
namespace topo::travel {

/// Sets unknown cells between free ones to free: at 20 m the beams of a scan are 9 cm apart, and the stripes
/// between them are no frontier. A cell is between when the nearest known cells on both sides, along a row, a
/// column or a diagonal and at most `reach` cells away, are free.
void close_gaps(grid::DenseMap& map, int reach);

/// Sets the unknown cells of the disc around a position of the robot to free: the scanner covers 270 degrees
/// and never covers the floor under the robot. The array's border stays unknown.
void free_disc(grid::DenseMap& map, const types::Vector2& centre, double radius_m);

/// Sets cells with faint evidence (TravelMapParams) to occupied. It is enough for driving, while the map
/// itself needs more (grid::state_of).
void occupy_faint(grid::DenseMap& map, const grid::OccupancyGrid& grid, const TravelMapParams& params);

/// Sets cells around a position of the robot to free when only weak evidence occupies them.
void free_trail(grid::DenseMap& map, const grid::OccupancyGrid& grid, const types::Vector2& centre,
                double radius_m);

/// Sets occupied cells around a robot's start to free, where all cells that hang together with them (eight
/// neighbours) lie within the radius. Robots that enter together scan each other before they hear of each
/// other, and a robot that stood there is no obstacle. A wall beside which it stood goes on, and stays.
void free_start(grid::DenseMap& map, const types::Vector2& centre, double radius_m);

/// Sets cells outside the limits to occupied: no route leads there, and nothing behind them remains to be
/// explored.
void apply_limits(grid::DenseMap& map, const types::AreaLimits& limits);

/// Applies all steps to a generation of the map. `route_radius_m` is the radius that a route keeps free
/// around the robot's centre (grid::TravelRules::radius_m: the swing radius and a margin).
grid::DenseMap prepare_map(const grid::OccupancyGrid& grid, const DrivenWays& ways,
                           const types::AreaLimits& limits, double route_radius_m,
                           const TravelMapParams& params);

/// End points of a scan within `range_max_m`, in map, that both neighbouring beams confirm to within
/// `step_m`: a lone point is often a mixed pixel.
std::vector<types::Vector2> confirmed_points(const types::Scan& scan, const types::Se2& T_map_laser,
                                             double range_max_m, float step_m);

/// What becomes of points where the map has an obstacle already: around them the clearance is low, unless a
/// path was kept open there.
enum class MapObstacles : std::uint8_t { kSkip, kTake };

/// Adds points to a clearance map as obstacles, up to `reach_m` around each. Clearance never grows.
void lower_clearance(const grid::DenseMap& map, std::span<const types::Vector2> obstacles, double reach_m,
                     std::vector<float>& clearance_m, MapObstacles of_map = MapObstacles::kSkip);

/// How far a breadcrumb path stays open.
struct TrailRules {
  double open_m = 0.0;         ///< minimum clearance on the path
  double above_m = 0.0;        ///< only where the clearance without this rule is at least this
  double within_m = HUGE_VAL;  ///< distance from the robot
  double gap_m = RouteMapParams{}.keyframe_gap_m;  ///< between two keyframes, at most
};

/// Keeps the path of a robot passable, so that the robot can return despite suspected obstacles. Applies
/// `rules` to the lines between consecutive keyframes of the path that are close to each other. The robot's
/// cell `here` does not change: were it open, the robot would leave over open cells only, and not over any
/// cells around it (grid::TravelRules::start_m).
void keep_trail_open(const grid::DenseMap& map, std::span<const types::KeyframePose> way,
                     grid::CellIndex here, const TrailRules& rules, std::vector<float>& clearance_m);

/// Sets occupied cells that are seen to be free (seen_through.hpp) to free. Not where the limits keep out,
/// nor where one of the `obstacles` that the same scan sees is within `clear_m`. Returns their indices.
std::vector<std::size_t> open_seen_through(grid::DenseMap& map, std::span<const types::Vector2> centres,
                                           const types::AreaLimits& limits,
                                           std::span<const types::Vector2> obstacles, double clear_m);

/// Sets occupied cells beneath a robot at `here` to free, within what its outline covers in every heading,
/// but where the limits keep out. Returns their indices.
std::vector<std::size_t> open_beneath(grid::DenseMap& map, const types::Vector2& here, double radius_m,
                                      const types::AreaLimits& limits);

}  // namespace topo::travel
