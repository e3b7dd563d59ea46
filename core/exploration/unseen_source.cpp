// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "core/exploration/sources.hpp"
#include "core/grid/end_of_way.hpp"
#include "core/grid/nearest_reachable.hpp"

namespace topo::exploration {
namespace {

/// A goal at the middle of a frontier, onto space without a known end.
goals::Goal goal_at(const goals::Frontier& frontier, const Situation& situation, const grid::DenseMap& map) {
  goals::Goal goal;
  goal.p_map = map.centre_of(map.cell(goals::middle_of(map, frontier.cells)));
  goal.opening = frontier.centroid;
  goal.opening_m = frontier.width_m;
  goal.behind_m2 = HUGE_VAL;
  goal.chance = chance_of(frontier, map, situation);
  return goal;
}

}  // namespace

std::vector<Candidate> unseen_way_candidates(std::span<const goals::Frontier> onto_much,
                                             const Situation& situation, const travel::RouteMap& route_map,
                                             const DeferredGoals& deferred, const ExplorationParams& params) {
  const grid::DenseMap& map = route_map.map();
  const CandidateParams& limits = params.candidate;
  std::vector<goals::Goal> cut_off = situation.analysis.goals.goals;
  for (const goals::Frontier& frontier : onto_much) cut_off.push_back(goal_at(frontier, situation, map));
  std::vector<goals::Goal> before_it;
  for (goals::Goal goal : cut_off) {
    const grid::CellIndex at = map.cell_at(goal.p_map);
    if (grid::nearest_to_stay_at(map, route_map.field(), at, limits.cell_reach_m)) continue;
    const auto cell =
        grid::end_of_way(map, route_map.clearance_m(), route_map.field(), at, route_map.rules().radius_m,
                         {limits.unknown_reach_m, limits.unknown_way_m});
    if (!cell) continue;
    goal.p_map = map.centre_of(*cell);
    before_it.push_back(goal);
  }
  return reachable(proposed_by(Source::kGap, before_it), situation, route_map, deferred, params).candidates;
}

}  // namespace topo::exploration
