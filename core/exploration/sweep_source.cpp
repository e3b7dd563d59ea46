// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "core/exploration/sources.hpp"

namespace topo::exploration {

bool has_final_sweep(const ExplorationParams& params) {
  return params.finish == Finish::kComplete && row_of(params.strategy).tours;
}

SweepState swept(SweepState state, std::span<const Candidate> others, bool cut_off,
                 const Situation& situation, const travel::RouteMap& map, const ExplorationParams& params) {
  const team::Roster& roster = situation.team.roster;
  state.sweep.settle(map.map(), situation.now);
  for (const team::StatusMessage* mate : roster.heard(situation.now)) state.sweep.share(mate->looked);
  if (!others.empty() || (cut_off && !state.meanwhile)) return state;
  const bool coordinated = row_of(params.strategy).rule != team::Rule::kAlone;
  const bool is_awaited = !coordinated || !mates_have_goals(roster, situation.now);
  const EndingParams& ending = params.ending;
  state.sweep.find({map.map(), map.revision(), map.known_m2(), map.field(), situation.analysis.walls,
                    params.candidate.pocket_reach_m},
                   situation.now, is_awaited ? ending.sweep_again : ending.sweep_again_meanwhile);
  return state;
}

Reachable viewpoint_candidates(const FinalSweep& sweep, const Situation& situation,
                               const travel::RouteMap& map, const CandidateParams& params) {
  const std::vector<goals::Goal> goals = sweep.goals();
  const std::vector<std::uint64_t> numbers = sweep.numbers();
  std::vector<ProposedGoal> viewpoints;
  for (std::size_t i = 0; i < goals.size(); ++i)
    viewpoints.push_back({goals[i], {Source::kViewpoint, numbers[i]}});
  // From beside a visited goal another part is visible: nothing is deferred here.
  Reachable found;
  const Reach reach{map.map(), map.clearance_m(), map.field(), map.rules().radius_m};
  found.candidates =
      candidates_of(viewpoints, reach, DeferredGoals{}, situation.T_map_base, {}, params, found.cut_off);
  const auto dropped = std::erase_if(found.candidates, [&](const Candidate& c) {
    return (map.map().centre_of(c.cell) - c.goal.p_map).norm() > sweep.reached_m();
  });
  found.cut_off = found.cut_off || dropped > 0;
  return found;
}

}  // namespace topo::exploration
