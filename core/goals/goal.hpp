// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/types/se2.hpp"

namespace topo::goals {

enum class Side : std::uint8_t { kEast, kNorth, kWest, kSouth, kNone };  ///< of a place's box, compass frame
std::string_view to_text(Side side);

/// Result of the filters for a candidate.
enum class Verdict : std::uint8_t {
  kAccepted,
  kInternal,   ///< a boundary between two places, not a frontier of the map
  kNoOpening,  ///< too little unknown space behind it, or no room before it
  kVisited,    ///< a robot was there already
  kServed,     ///< in sight of another goal
  kUnlikely,   ///< the chance that it leads onto a large area is too small
};
/// The verdict as one phrase for the user.
std::string_view to_text(Verdict verdict);

/// A viewpoint for exploration.
struct Goal {
  types::Vector2 p_map{0.0, 0.0};    ///< destination of the robot: free, with clearance for it
  types::Vector2 opening{0.0, 0.0};  ///< middle of the frontier that it serves, in map
  double opening_m = 0.0;            ///< width of that frontier
  double behind_m2 = HUGE_VAL;       ///< enclosed unknown space behind it; HUGE_VAL: not enclosed
  double chance = 0.0;               ///< of a large area behind it (opening_chance.hpp), where not enclosed
  std::uint16_t place = 0;           ///< label in the place map; 0: none
  Side side = Side::kNone;
  Verdict verdict = Verdict::kAccepted;
};

/// The accepted goals and all rejected candidates.
struct GoalSet {
  std::vector<Goal> goals;
  std::vector<Goal> rejected;
};

}  // namespace topo::goals
