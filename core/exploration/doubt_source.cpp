// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "core/exploration/sources.hpp"
#include "core/travel/closed_way.hpp"

namespace topo::exploration {

std::vector<Candidate> doubted_candidates(const Situation& situation, const travel::RouteMap& map,
                                          std::span<const types::Vector2> looked_again,
                                          const ExplorationParams& params) {
  std::vector<types::Vector2> doubted(situation.doubted.begin(), situation.doubted.end());
  if (const auto way =
          travel::closed_way(map.map(), map.field(), situation.driven, params.homing.look_from_m))
    doubted.push_back(way->look_from);
  std::vector<goals::Goal> places;
  for (const types::Vector2& place : doubted) {
    const bool was_there = std::ranges::any_of(looked_again, [&](const types::Vector2& p) {
      return (p - place).norm() < params.ending.looked_again_m;
    });
    if (!was_there) places.push_back({.p_map = place, .opening = place});
  }
  const Reach reach{map.map(), map.clearance_m(), map.field(), map.rules().radius_m};
  bool cut_off = false;
  return candidates_of(proposed_by(Source::kDoubt, places), reach, DeferredGoals{}, situation.T_map_base,
                       situation.now, params.candidate, cut_off);
}

}  // namespace topo::exploration
