// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/goals/essential_goals.hpp"

namespace topo::goals {

/// An opening that may lead on.
struct Prospect {
  types::Vector2 p_map{0.0, 0.0};  ///< where its own goal would be, steered
  grid::CellIndex stand;           ///< the cell with room for the robot that is nearest to the opening
  double chance = 0.0;             ///< that it leads on
};

/// Where a robot may stand to serve openings.
struct StandingPlace {
  types::Vector2 p_map{0.0, 0.0};
  std::vector<std::uint32_t> serves;  ///< indices of prospects, ascending
  double away_m = 0.0;                ///< from the stands of those, on average
  bool is_shared = false;             ///< no opening's own
};

/// Each prospect's own place, in their order, then those on the skeleton's axis that serve several. A place
/// serves a prospect whose stand is within in_sight_m of it and in sight: who is there sees what the opening
/// is for. Costs the axis, and lines of sight from it to the stands nearby.
std::vector<StandingPlace> standing_places(const GoalInput& input, std::span<const Prospect> prospects,
                                           const GoalParams& params);

}  // namespace topo::goals
