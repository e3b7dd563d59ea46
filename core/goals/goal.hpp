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

/// What a candidate became.
enum class Verdict : std::uint8_t {
  kAccepted,
  kInternal,   ///< a boundary between two places, not a frontier of the map
  kNoOpening,  ///< no unknown space behind it that a robot could enter
  kVisited,    ///< a robot was there already
  kServed,     ///< in sight of another goal
  kUnlikely,   ///< too small a chance that it leads onto much
};
/// One sentence for a person.
std::string_view to_text(Verdict verdict);

/// A place to go to in order to see more.
struct Goal {
  types::Vector2 p_map{0.0, 0.0};    ///< where the robot shall go: free, with room for it
  types::Vector2 opening{0.0, 0.0};  ///< middle of the frontier that it is for, in map
  double opening_m = 0.0;            ///< width of that frontier
  double behind_m2 = HUGE_VAL;       ///< enclosed unknown space behind it; HUGE_VAL: it leads on
  double chance = 0.0;               ///< that it leads onto much (opening_chance.hpp), where it leads on
  std::uint16_t place = 0;           ///< label in the place map, 0 without one
  Side side = Side::kNone;
  Verdict verdict = Verdict::kAccepted;
};

/// Accepted goals, and every candidate that was not.
struct GoalSet {
  std::vector<Goal> goals;
  std::vector<Goal> rejected;
};

}  // namespace topo::goals
