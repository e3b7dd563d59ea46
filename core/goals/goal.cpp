// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/goal.hpp"

namespace topo::goals {

std::string_view to_text(Side side) {
  switch (side) {
    case Side::kEast:
      return "east";
    case Side::kNorth:
      return "north";
    case Side::kWest:
      return "west";
    case Side::kSouth:
      return "south";
    case Side::kNone:
      break;
  }
  return "none";
}

std::string_view to_text(Verdict verdict) {
  switch (verdict) {
    case Verdict::kAccepted:
      return "accepted";
    case Verdict::kInternal:
      return "leads to another known place";
    case Verdict::kNoOpening:
      return "little or no unknown space behind it before a wall, or no room for a robot before it";
    case Verdict::kVisited:
      return "a robot was there already";
    case Verdict::kServed:
      return "in sight of another goal";
    case Verdict::kUnlikely:
      return "too much of what is behind it is closed, by walls or known space, to lead onto much";
  }
  return "unknown";
}

}  // namespace topo::goals
