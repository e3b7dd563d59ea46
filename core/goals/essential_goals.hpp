// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/goals/goal.hpp"
#include "core/grid/dense_map.hpp"
#include "core/places/segmentation/place_map.hpp"
#include "core/places/skeleton/skeleton.hpp"

namespace topo::goals {

struct GoalParams {
  double robot_radius_m = 0.297;  ///< as grid::TravelRules::radius_m
  double opening_min_m = 0.75;    ///< a frontier narrower than this is a nook
  double clear_m = 0.45;          ///< steering up the distance field ends here
  double node_reach_m = 1.0;      ///< a free skeleton node this near takes the goal
  double in_sight_m = 3.0;        ///< a goal serves the openings within this that it sees
  double worth_min = 0.28;        ///< of the chances of what a goal serves, in sum: less is no goal
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
/// filters, each a function of its own: inner borders and the pose history (filters.hpp), the opening check
/// (opening_check.hpp), and of what is left few places to stand that serve what is worth it
/// (opening_chance.hpp, standing_places.hpp, greedy_cover.hpp). The candidate of a side stands not at its
/// midpoint but at the openings there (openings.hpp); a side without any has one at its midpoint, which is
/// rejected. Goals in the order of places and sides. Does not depend on the order of the paths.
///
/// Departure from the paper: its filter by the distance from a place's centroid drops what stands on a long
/// side, a door of a corridor as well as the shadow of a cupboard. What it was for, that a place should not
/// have several goals which one robot sees from one point, is what the cover looks for itself: with that
/// filter before it as many goals leave a fifth more openings onto space without one.
GoalSet essential_goals(const GoalInput& input, const GoalParams& params = {});

}  // namespace topo::goals
