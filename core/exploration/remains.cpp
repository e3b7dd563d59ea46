// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/remains.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "core/goals/frontiers.hpp"
#include "core/goals/opening_check.hpp"
#include "core/grid/distance.hpp"
#include "core/travel/narrow_passages.hpp"

namespace topo::exploration {
namespace {

std::string fixed(double value, int decimals) {
  std::array<char, 32> text{};
  const int n = std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return {text.data(), std::min(static_cast<std::size_t>(std::max(n, 0)), text.size() - 1)};
}

/// The middles of the frontiers that the robot does not reach, where it could go on behind.
std::vector<std::uint32_t> shut_off(const Situation& situation, const travel::RouteMap& map,
                                    const ExplorationParams& params) {
  std::vector<std::uint32_t> ends;
  for (const goals::Frontier& frontier : goals::find_frontiers(map.map(), params.frontier_min_m)) {
    const std::uint32_t middle = goals::middle_of(map.map(), frontier.cells);
    if (std::isinf(map.field().cost_m[middle]) &&
        goals::leads_to_unknown(map.map(), frontier.cells, situation.essential))
      ends.push_back(middle);
  }
  return ends;
}

}  // namespace

Intent note_what_remains(const Situation& situation, travel::RouteMap& map, const ExplorationParams& params,
                         Intent intent) {
  for (const LeftOutGoal& left : intent.outlook.left_out)
    intent.log.note(situation.now, left.p_map,
                    "left out: " + fixed(left.gain_m2, 1) + " m2 for " + fixed(left.time_s, 0) + " s");
  map.settle(HUGE_VAL);
  const double needed_m = 2.0 * map.rules().tight_m;
  const std::vector<std::uint32_t> ends = shut_off(situation, map, params);
  if (ends.empty()) return intent;
  // Of obstacles alone: beside a frontier there is no room for a robot, and that is not what is too narrow.
  const std::vector<float> clearance_m = grid::clearance_m(map.map(), grid::Boundary::kOccupied);
  for (const travel::NarrowPassage& passage :
       travel::narrow_passages(map.map(), clearance_m, map.field(), ends)) {
    if (passage.width_m >= needed_m)
      continue;  // closed by what is felt, seen now or unknown, not by obstacles of the map
    intent.log.note(
        situation.now, passage.p_map,
        "too narrow: an opening of " + fixed(passage.width_m, 2) + " m, " + fixed(needed_m, 2) + " m needed");
  }
  return intent;
}

}  // namespace topo::exploration
