// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/goals/continued_walls.hpp"
#include "core/goals/goal.hpp"
#include "core/grid/dense_map.hpp"
#include "core/places/segmentation/place_map.hpp"
#include "core/places/skeleton/skeleton.hpp"

namespace topo::goals {

/// Filters and cover of the essential goals. Where no source is given, chosen on partial maps of the sixteen
/// plans of doc/results.md.
struct GoalParams {
  double robot_radius_m = 0.297;   ///< as grid::TravelRules::radius_m
  double opening_min_m = 0.75;     ///< a narrower frontier is not an opening
  double clear_m = 0.45;           ///< clearance at which steering up the distance field ends
  double node_reach_m = 1.0;       ///< a free skeleton node within this distance becomes the goal
  double in_sight_m = 3.0;         ///< a goal serves the openings within this distance that are in its sight
  double worth_min = 0.55;         ///< minimum sum of the chances of the openings that a goal serves: less
                                   ///< than a door of 0.95 m has (0.58)
  double internal_reach_m = 0.5;   ///< another place this near to the middle of a side lies beyond that side
  double visited_radius_m = 1.0;   ///< of the pose-history filter (paper section II-E)
  double wide_ratio = 2.0;         ///< an opening of this multiple of opening_min_m is wide: for it
  double wide_travel_ratio = 1.2;  ///< the paths must cover this multiple of that radius
  double axis_step_m = 0.3;        ///< between viewpoints on the skeleton's axis
  double room_reach_m = 6.0;       ///< maximum distance from an opening to its goal, through free space
  double behind_m = 2.4;           ///< depth to which the unknown space behind an opening is looked at, and
                                   ///< the least in which a robot goes on (opening_check.hpp)
  double behind_m2 = 4.0;          ///< minimum area of that space; no room worth exploring is smaller
  double look_m = 0.0;             ///< of opening_check.hpp: depth to which that area is counted, when it is
                                   ///< more than behind_m
  ContinuedWallParams continued;
};

/// Input of the filters. The spans are borrowed for the call.
struct GoalInput {
  const grid::DenseMap& map;
  std::span<const float> clearance_m;  ///< with kOccupiedOrUnknown
  const places::Skeleton& skeleton;
  const places::PlaceMap& places;
  std::span<const types::Segment> continued;  ///< walls, where they have not been seen (continued_walls.hpp)
  std::span<const std::vector<types::Vector2>> visited;  ///< corrected paths of all robots, in map
};

/// The essential goals of paper section II-E. Candidates on the sides of every place's box pass a stack of
/// filters, each a function: internal borders and the pose history (filters.hpp), and the space behind them
/// (space_behind.hpp). For the remaining openings a few viewpoints are selected that serve all openings with
/// enough expected information gain (opening_chance.hpp, standing_places.hpp, greedy_cover.hpp). The
/// candidates of a side are located at its openings, not at its midpoint (openings.hpp); a side without
/// openings has one at its midpoint, which is rejected. Goals are in the order of places and sides. The
/// result does not depend on the order of the paths.
///
/// Departure from the paper: its filter by the distance from a place's centroid drops all candidates on a
/// long side, a door of a corridor as well as the shadow of a cupboard. The purpose of that filter, that a
/// place does not have several goals which one robot sees from one point, is met by the cover: with the
/// filter in front of the cover the same number of goals leaves a fifth more openings onto space without a
/// goal.
GoalSet essential_goals(const GoalInput& input, const GoalParams& params = {});

}  // namespace topo::goals
