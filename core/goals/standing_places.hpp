// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/goals/essential_goals.hpp"

namespace topo::goals {

/// An opening that may lead onto a large area.
struct Prospect {
  types::Vector2 p_map{0.0, 0.0};  ///< its own goal, after steering
  grid::CellIndex stand;           ///< the cell nearest to the opening that has clearance for the robot
  double chance = 0.0;             ///< that it leads onto a large area
};

/// A viewpoint that serves openings.
struct StandingPlace {
  types::Vector2 p_map{0.0, 0.0};
  std::vector<std::uint32_t> serves;  ///< indices of prospects, ascending
  double away_m = 0.0;                ///< mean distance from their stands; an own stand counts as 0
  bool is_shared = false;             ///< true: not the own viewpoint of an opening
};

/// The own viewpoint of each prospect, in their order, then viewpoints on the skeleton's axis that serve
/// several. A viewpoint serves its own prospect, and every prospect whose stand is within in_sight_m and in
/// sight: a robot there sees what the opening's goal is for. Cost: the axis, and lines of sight from it to
/// the stands nearby.
std::vector<StandingPlace> standing_places(const GoalInput& input, std::span<const Prospect> prospects,
                                           const GoalParams& params);

}  // namespace topo::goals
