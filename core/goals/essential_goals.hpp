// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/goals/goal.hpp"
#include "core/grid/dense_map.hpp"
#include "core/places/place_map.hpp"
#include "core/places/skeleton.hpp"

namespace topo::goals {

struct GoalParams {
  double robot_radius_m = 0.297;  ///< as grid::TravelRules::radius_m
  double opening_min_m = 0.90;    ///< a frontier narrower than this is a nook
  double clear_m = 0.45;          ///< steering up the distance field ends here
  double node_reach_m = 1.0;      ///< a free skeleton node this near takes the goal
  double centroid_ratio = 0.35;   ///< of a place's half extent: nearer to the centroid is dropped
  double separation_m = 1.0;      ///< of two goals
  double in_sight_m = 3.0;        ///< of two goals that see each other
  double stand_in_m = 4.0;        ///< of a goal near its place's centroid and one further out
  double visited_radius_m = 1.0;  ///< the pose-history filter (paper section II-E)
  double room_reach_m = 6.0;      ///< so far from an opening a goal may be, through free space
  double behind_m = 2.4;          ///< an opening leads so far into unknown space,
  double behind_m2 = 4.0;         ///< and onto so much of it; a room worth the way is no smaller
};

/// What the filters look at. Spans are borrowed for the call.
struct GoalInput {
  const grid::DenseMap& map;
  std::span<const float> clearance_m;  ///< with kOccupiedOrUnknown
  const places::Skeleton& skeleton;
  const places::PlaceMap& places;
  std::span<const std::vector<types::Vector2>> visited;  ///< corrected paths of all robots, in map
};

/// The handful of paper section II-E: candidates on the sides of every place's box, then the stack of
/// filters, each a function of its own (filters.hpp). The candidate of a side stands not at its midpoint but
/// at the openings there (openings.hpp); a side without any has one at its midpoint, which is rejected.
/// Goals in the order of places and sides. Does not depend on the order of the paths.
GoalSet essential_goals(const GoalInput& input, const GoalParams& params = {});

}  // namespace topo::goals
