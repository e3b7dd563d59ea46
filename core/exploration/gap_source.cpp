// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/exploration/sources.hpp"
#include "core/goals/opening_chance.hpp"
#include "core/goals/opening_check.hpp"

namespace topo::exploration {
namespace {

/// Label of the place that contains a point; 0: none. The places may be those of an older map.
std::uint16_t place_at(const analysis::Analysis& analysis, const types::Vector2& p_map) {
  const grid::CellIndex cell = analysis.map.cell_at(p_map);
  if (!analysis.map.contains(cell) || analysis.places.labels.empty()) return 0;
  return analysis.places.labels[analysis.map.index(cell)];
}

std::vector<ProposedGoal> goals_at(std::span<const goals::Frontier> frontiers, Source source,
                                   double behind_min_m2, const Situation& situation,
                                   const travel::RouteMap& map, const CandidateParams& params) {
  std::vector<goals::Goal> openings;
  for (const goals::Frontier& frontier : frontiers) {
    auto opening = frontier_goal(map.map(), map.field(), frontier, params, behind_min_m2);
    if (!opening) continue;
    opening->place = place_at(situation.analysis, opening->p_map);
    if (std::isinf(opening->behind_m2)) opening->chance = chance_of(frontier, map.map(), situation);
    openings.push_back(*opening);
  }
  return proposed_by(source, openings);
}

/// True when `member` of a candidate is within some distance of a point.
bool is_beside(const types::Vector2& p_map, std::span<const Candidate> candidates,
               types::Vector2 goals::Goal::*member, double within_m) {
  return std::any_of(candidates.begin(), candidates.end(),
                     [&](const Candidate& c) { return (c.goal.*member - p_map).norm() < within_m; });
}

}  // namespace

double chance_of(const goals::Frontier& frontier, const grid::DenseMap& map, const Situation& situation) {
  const double reach_m = situation.essential.behind_m;
  return goals::chance_to_lead_on(
      goals::space_behind(map, frontier.cells, situation.analysis.continued, reach_m), reach_m);
}

Reachable gap_candidates(std::span<const goals::Frontier> frontiers, std::span<const Candidate> beside,
                         const Situation& situation, const travel::RouteMap& map,
                         const DeferredGoals& deferred, const ExplorationParams& params) {
  std::vector<goals::Frontier> others;
  for (const goals::Frontier& frontier : frontiers) {
    if (!is_beside(frontier.centroid, beside, &goals::Goal::opening, params.tour.same_opening_m))
      others.push_back(frontier);
  }
  Reachable gaps =
      reachable(goals_at(others, Source::kGap, params.tour.pocket_m2, situation, map, params.candidate),
                situation, map, deferred, params);
  std::erase_if(gaps.candidates, [&](const Candidate& gap) {
    return is_beside(gap.goal.p_map, beside, &goals::Goal::p_map, params.tour.same_stand_m);
  });
  return gaps;
}

std::vector<goals::Frontier> overlooked(std::vector<goals::Frontier> frontiers, const travel::RouteMap& map,
                                        const goals::GoalParams& essential, const TourParams& params) {
  goals::GoalParams onto_much = essential;
  onto_much.behind_m2 = params.overlooked_m2;
  onto_much.look_m = params.overlooked_look_m;
  std::erase_if(frontiers, [&](const goals::Frontier& frontier) {
    // The first, which most fail, looks less far.
    return !goals::leads_to_unknown(map.map(), frontier.cells, essential) ||
           !goals::leads_to_unknown(map.map(), frontier.cells, onto_much);
  });
  return frontiers;
}

Reachable frontier_candidates(std::span<const goals::Frontier> frontiers, const Situation& situation,
                              travel::RouteMap& map, const DeferredGoals& deferred,
                              const ExplorationParams& params) {
  map.settle(HUGE_VAL);
  return reachable(goals_at(frontiers, Source::kFrontier, 0.0, situation, map, params.candidate), situation,
                   map, deferred, params);
}

}  // namespace topo::exploration
