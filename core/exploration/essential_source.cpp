// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <iterator>

#include "core/exploration/sources.hpp"

namespace topo::exploration {

Reachable reachable(std::span<const ProposedGoal> goals, const Situation& situation,
                    const travel::RouteMap& map, const DeferredGoals& deferred,
                    const ExplorationParams& params) {
  Reachable found;
  const Reach reach{map.map(), map.clearance_m(), map.field(), map.rules().radius_m};
  found.candidates = candidates_of(goals, reach, deferred, situation.T_map_base, situation.now,
                                   params.candidate, found.cut_off);
  if (row_of(params.strategy).rule == team::Rule::kAlone) return found;
  std::erase_if(found.candidates, [&](const Candidate& c) {
    return mate_was_at(situation.team.roster, situation.now, c.goal.p_map, params.deferral.same_m);
  });
  return found;
}

Reachable essential_candidates(const Situation& situation, const travel::RouteMap& map,
                               const DeferredGoals& deferred, const ExplorationParams& params, bool homing) {
  const goals::GoalSet& goals = situation.analysis.goals;
  Reachable found = reachable(proposed_by(Source::kEssential, goals.goals), situation, map, deferred, params);
  if (!found.candidates.empty() || found.cut_off || homing) return found;
  std::vector<goals::Goal> unlikely;
  std::ranges::copy_if(goals.rejected, std::back_inserter(unlikely),
                       [](const goals::Goal& g) { return g.verdict == goals::Verdict::kUnlikely; });
  found.cut_off =
      reachable(proposed_by(Source::kEssential, unlikely), situation, map, deferred, params).cut_off;
  return found;
}

}  // namespace topo::exploration
