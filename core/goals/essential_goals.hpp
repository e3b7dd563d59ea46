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
  double opening_min_m = 0.75;    ///< a narrower frontier is not an opening
  double clear_m = 0.45;          ///< clearance at which steering up the distance field ends
  double node_reach_m = 1.0;      ///< a free skeleton node within this distance becomes the goal
  double in_sight_m = 3.0;        ///< a goal serves the openings within this distance that are in its sight
  double worth_min = 0.28;        ///< minimum sum of the chances of the openings that a goal serves
  double visited_radius_m = 1.0;  ///< of the pose-history filter (paper section II-E)
  double room_reach_m = 6.0;      ///< maximum distance from an opening to its goal, through free space
  double behind_m = 2.4;          ///< minimum depth of the unknown space behind an opening
  double behind_m2 = 4.0;         ///< minimum area of that space; no room worth exploring is smaller
};

/// Input of the filters. The spans are borrowed for the call.
struct GoalInput {
  const grid::DenseMap& map;
  std::span<const float> clearance_m;  ///< with kOccupiedOrUnknown
  const places::Skeleton& skeleton;
  const places::PlaceMap& places;
  std::span<const std::vector<types::Vector2>> visited;  ///< corrected paths of all robots, in map
};

/// The essential goals of paper section II-E. Candidates on the sides of every place's box pass a stack of
/// filters, each a function: internal borders and the pose history (filters.hpp), and the opening check
/// (opening_check.hpp). For the remaining openings a few viewpoints are selected that serve all openings with
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
