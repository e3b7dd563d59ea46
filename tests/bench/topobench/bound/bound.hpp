// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/types/robot_limits.hpp"
#include "tests/bench/topobench/bound/sight.hpp"
#include "tests/bench/topobench/bound/tours.hpp"
#include "tests/bench/topobench/bound/way_map.hpp"
#include "tests/sim/world.hpp"

namespace topo::bench::bound {

/// Shares of the area whose ways are bounded.
inline constexpr std::array<double, 3> kBoundShares{0.90, 0.95, 0.99};

struct BoundParams {
  SightParams sight;
  double spacing_m = 0.8;  ///< of the places to look from
  double look_m = 0.25;    ///< and so often on the way from one to the next
};

struct BoundInput {
  const sim::World* world = nullptr;
  const sim::Raster* poses = nullptr;    ///< where the robots get (sim::reachable_area)
  const sim::Raster* visible = nullptr;  ///< what counts
  std::vector<sim::Vector2> starts;      ///< of the robots
  types::DriveLimits limits;
};

/// Of the robot with the longest way, for one share of the area.
struct ShareBound {
  double lower_m = 0.0;  ///< no team sees the share with less, in cells and places as fine as the parameters
  double way_m = 0.0;    ///< tours that were found do
  double full_speed_s = 0.0, lower_s = 0.0;  ///< both at the permitted speed
  double own_motion_s = 0.0;  ///< the tours with the robot's ramps, turning on the spot at sharp corners
};

struct Bound {
  std::array<ShareBound, kBoundShares.size()> shares;
  std::vector<Way> ways;     ///< for the last share, from each start to its last stop
  bool is_feasible = false;  ///< the last share is seen from the places
};

/// With full knowledge of the building. Achievable: greedy covers by places to look from, for which
/// far ones cost nothing or much, each shared out as tours of one robot and of more, of which stops are left
/// out that are seen on the way; the best of them. Lower: the larger of two. The farthest part of what must
/// be seen has to be looked at from somewhere; and patches of the floor, each too large to be left out as a
/// whole, must each be looked at from one of the places that see any of it: the ways of all robots make a
/// tree between those sets of places, so that the longest is at least the smallest tree over the number of
/// robots.
Bound find_bound(const BoundInput& input, const BoundParams& params);

/// Places to look from: in every square of this side the passable cell next to its middle.
std::vector<sim::Vector2> places_to_look_from(const WayMap& ways, double spacing_m);

/// A look on a robot's way.
struct Look {
  double way_m = 0.0;  ///< driven until there
  sim::Vector2 at{0.0, 0.0};
};
/// Of a way: at every bend, and on what is straight so often.
std::vector<Look> looks_on(const Way& way, double look_m);

/// How far robots that drive alike have driven when they have seen `wanted` cells. Infinite: they never see
/// so many.
double way_until_m(const Sight& sight, std::span<const std::vector<Look>> robots, std::size_t wanted);

/// The lower one alone.
double lower_bound_m(double share, const WayMap& ways, const Sight& sight,
                     std::span<const sim::Vector2> places, std::span<const CellSet> seen,
                     std::span<const sim::Vector2> starts, double spacing_m);

/// Numbers of places that see so many cells together, the one that adds most for its cost first; all useful
/// ones if they do not. The first place costs nothing. `cost`: of each, above 0; empty: all cost the same.
std::vector<std::size_t> greedy_cover(std::span<const CellSet> seen, std::size_t cells_wanted,
                                      std::span<const double> cost = {});

/// Time to drive a polyline with the limits: speed up, brake and turn on the spot where it bends by more than
/// 0.9 rad (motion::FollowerRules::turn_begin_rad). From and to a stand.
double drive_time_s(const Way& way, const types::DriveLimits& limits);

}  // namespace topo::bench::bound
