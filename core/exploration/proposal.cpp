// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/exploration/sources.hpp"
#include "core/grid/nearest_reachable.hpp"

namespace topo::exploration {
namespace {

/// Candidates beyond the settled part of the fine search get the costs of the coarse map.
void estimate_far_ones(std::vector<Candidate>& candidates, const types::Se2& T_map_base,
                       travel::RouteMap& map, const ExplorationParams& params) {
  struct FarOne {
    Candidate* candidate;
    std::optional<grid::CellIndex> coarse_cell;
  };
  std::vector<FarOne> far;
  for (Candidate& c : candidates) {
    if (static_cast<double>(map.field().cost_m[map.map().index(c.cell)]) >= map.settled_m())
      far.push_back({&c, {}});
  }
  if (far.empty()) return;
  const travel::CoarseMap& coarse = map.coarse();
  const grid::TravelField& coarse_field = map.coarse_field();
  for (FarOne& one : far) {
    const grid::CellIndex beside = coarse.map.cell_at(map.map().centre_of(one.candidate->cell));
    one.coarse_cell = grid::nearest_reachable(coarse.map, coarse_field, beside, params.tour.far_reach_m);
  }
  // When one of them has a route on the fine map only, the costs of all come from that map.
  const bool has_all =
      std::all_of(far.begin(), far.end(), [](const FarOne& one) { return one.coarse_cell.has_value(); });
  if (!has_all) map.settle(HUGE_VAL);
  for (const auto& [candidate, coarse_cell] : far)
    candidate->cost_m =
        has_all ? way_cost_m(coarse.map, coarse_field, *coarse_cell, T_map_base, params.candidate)
                : way_cost_m(map.map(), map.field(), candidate->cell, T_map_base, params.candidate);
}

Proposal propose_frontiers(const Situation& situation, travel::RouteMap& map, const ExplorationParams& params,
                           const DeferredGoals& deferred, SweepState sweep) {
  Proposal proposal;
  const std::vector<goals::Frontier> frontiers = goals::find_frontiers(map.map(), params.frontier_min_m);
  Reachable found = frontier_candidates(frontiers, situation, map, deferred, params);
  proposal.candidates = std::move(found.candidates);
  proposal.cut_off = found.cut_off;
  proposal.clusters = static_cast<int>(frontiers.size());
  proposal.sweep = std::move(sweep);
  return proposal;
}

void append(std::vector<Candidate>& candidates, const std::vector<Candidate>& more) {
  candidates.insert(candidates.end(), more.begin(), more.end());
}

/// Essential goals and gaps: all gaps when the exploration has to be complete; otherwise, when no essential
/// goal is left, the gaps through which the building continues. Viewpoints when neither is left. A sweep that
/// has begun continues in one tour with new goals; otherwise the robot would leave a corner that is close.
Proposal propose_tour(const Situation& situation, travel::RouteMap& map, const ExplorationParams& params,
                      bool homing, const DeferredGoals& deferred, SweepState sweep) {
  Proposal proposal;
  map.settle(params.tour.exact_m);
  std::vector<goals::Frontier> frontiers = goals::find_frontiers(map.map(), params.frontier_min_m);
  proposal.clusters = static_cast<int>(frontiers.size());
  Reachable found = essential_candidates(situation, map, deferred, params, homing);
  proposal.only_gaps = found.candidates.empty();
  const bool all_gaps = params.finish != Finish::kEssential;
  if (all_gaps || proposal.only_gaps) {
    if (!all_gaps) frontiers = overlooked(std::move(frontiers), map, situation.essential, params.tour);
    const Reachable gaps = gap_candidates(frontiers, found.candidates, situation, map, deferred, params);
    append(found.candidates, gaps.candidates);
    found.cut_off = found.cut_off || gaps.cut_off;
  }
  // A complete exploration looks into corners then.
  if (params.finish != Finish::kComplete && found.candidates.empty() && !homing) {
    if (all_gaps) frontiers = overlooked(std::move(frontiers), map, situation.essential, params.tour);
    found.candidates = unseen_way_candidates(frontiers, situation, map, deferred, params);
  }
  const bool sweeps = has_final_sweep(params) && !homing;
  if (sweeps) sweep = swept(std::move(sweep), found.candidates, found.cut_off, situation, map, params);
  if (!found.candidates.empty()) {
    sweep.sweep.interrupt(situation.now);
    sweep.meanwhile = false;
  }
  if (sweeps) {
    const Reachable viewpoints = viewpoint_candidates(sweep.sweep, situation, map, params.candidate);
    append(found.candidates, viewpoints.candidates);
    found.cut_off = found.cut_off || viewpoints.cut_off;
  }
  estimate_far_ones(found.candidates, situation.T_map_base, map, params);
  proposal.candidates = std::move(found.candidates);
  proposal.cut_off = found.cut_off;
  proposal.sweep = std::move(sweep);
  return proposal;
}

}  // namespace

Proposal propose(const Situation& situation, Searches searches, const ExplorationParams& params, bool homing,
                 const DeferredGoals& deferred, SweepState sweep) {
  return row_of(params.strategy).tours
             ? propose_tour(situation, searches.map, params, homing, deferred, std::move(sweep))
             : propose_frontiers(situation, searches.map, params, deferred, std::move(sweep));
}

std::vector<Candidate> propose_looks(const Situation& situation, Searches searches,
                                     const ExplorationParams& params, const Pursuit& pursuit,
                                     const SweepState& sweep) {
  if (!row_of(params.strategy).tours) return {};
  std::vector<Candidate> looks =
      doubted_candidates(situation, searches.map, pursuit, sweep.looked_again, params);
  estimate_far_ones(looks, situation.T_map_base, searches.map, params);
  return looks;
}

}  // namespace topo::exploration
