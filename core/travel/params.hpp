// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>

#include "core/types/stamp.hpp"

namespace topo::travel {

/// The map for planning, from the mapper's grid (travel_map.hpp).
struct TravelMapParams {
  /// Unknown cells this far from free ones on both sides are free: the beam spacing of 0.25 degrees at 30 m.
  double gap_m = 0.15;
  /// A cell with so many hits is occupied when one of so many observations is a hit: most beams pass through
  /// glass, or miss a thin obstacle. Weaker than grid::state_of, which decides what the map shows.
  unsigned faint_hits = 2, faint_one_in = 10;
  /// Of the radius that a route keeps free: what the outline covers in every heading (a P3-DX: 0.2125 of
  /// 0.297 m).
  double inner_share = 0.7;
  /// Beyond the radius that a route keeps free: error of hits on a robot's outline, twice the 30 mm of a
  /// UTM-30LX's range.
  double start_noise_m = 0.06;
};

/// From cells to points (path.hpp).
struct PathParams {
  std::size_t shortcut_cells = 40;  ///< 2 m with cells of 0.05 m: beyond a doorway, at low cost
  std::size_t shortcut_stride = 4;  ///< cells between two tried ends: finer steps change little
  int roundings = 4;                ///< of its corners
  double spacing_m = 0.1;           ///< of its points, about
  /// Points among which the robot is looked for, 3 m: it drives less between two uses of its path.
  std::size_t near_points = 30;
};

/// By how much a route on the coarse map may exceed the cheapest one there and still be the cheapest on the
/// fine map (far_route.hpp). tests/unit/core/travel/far_route_test.cpp holds that no shorter route is missed.
struct FarRouteParams {
  double factor = 1.05;
  double more_m = 1.5;
};

struct RouteMapParams {
  double live_noise_m = 0.05;   ///< error of a point of the newest scan, from scanner and pose
  double live_range_m = 3.0;    ///< more distant points are scanned again before they matter
  float live_step_m = 0.1F;     ///< from both neighbouring beams: an isolated point is often a mixed pixel
  double live_behind_m = 0.15;  ///< what a beam hits so far behind a point is not what stands there: three
                                ///< times the noise
  double island_m = 0.8;      ///< length and width of what may go away: a person with a bag; a P3-DX is 0.6 m
                              ///< across its corners
  double mate_m = 1.2;        ///< radius around a team-mate in which a route costs more
  double near_m = 6.0;        ///< longer routes are found on the coarse map
  int coarse_doublings = 2;   ///< cells of the coarse map: four times as wide
  double aim_search_m = 2.0;  ///< search around the robot before reachable_cell() looks for a cell
  double aim_beside_m = 0.5;  ///< distance between a point and the cell that replaces it
  double target_beside_m = 0.25;  ///< the same for a target of the operator: less, since the place was chosen
  double tight_ahead_m = 1.2;     ///< length of route tested for a passage that the robot does not enter
  double keyframe_gap_m = 0.8;    ///< between keyframes of a driven way: beyond, it was carried or lost
  TravelMapParams map;
  PathParams path;
  FarRouteParams far;
};

struct ObstacleMemoryParams {
  double same_echo_m = 0.15;      ///< echoes within this distance are one; the resolution of the sonar
  int echo_times = 3;             ///< an echo noted less often may be a reflection
  std::size_t echoes_max = 1000;  ///< limit of the stored echoes
  /// An obstacle that no laser detects is glass more often than a person.
  types::Duration echo_for = std::chrono::minutes(10), blocked_for = std::chrono::minutes(5);
  types::Duration forget_again = std::chrono::seconds(60);
  double blocked_radius_m = 0.25;  ///< of an obstacle at which the robot got stuck, which no sensor outlines
};

}  // namespace topo::travel
