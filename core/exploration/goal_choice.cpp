// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/goal_choice.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/goals/frontiers.hpp"
#include "core/grid/end_of_way.hpp"
#include "core/grid/nearest_reachable.hpp"

namespace topo::exploration {

double way_cost_m(const grid::DenseMap& map, const grid::TravelField& field, grid::CellIndex cell,
                  const types::Se2& T_map_base, const CandidateParams& params) {
  const double way_m = static_cast<double>(field.cost_m[map.index(cell)]);
  const std::vector<grid::CellIndex> route = grid::route_to(map, field, cell);
  if (route.size() < 2) return way_m;
  const auto beginning = static_cast<std::size_t>(std::lround(params.beginning_m / map.resolution_m));
  const types::Vector2 ahead =
      map.centre_of(route[std::min(beginning, route.size() - 1)]) - map.centre_of(route.front());
  const double turn_rad = types::wrap_angle(std::atan2(ahead.y(), ahead.x()) - T_map_base.theta_rad);
  return way_m + params.turn_m_per_rad * std::abs(turn_rad);
}

std::vector<ProposedGoal> proposed_by(Source source, std::span<const goals::Goal> goals) {
  std::vector<ProposedGoal> proposed;
  for (const goals::Goal& goal : goals) proposed.push_back({goal, {source, 0}});
  return proposed;
}

std::vector<Candidate> candidates_of(std::span<const ProposedGoal> goals, const Reach& reach,
                                     const DeferredGoals& deferred, const types::Se2& T_map_base,
                                     types::Stamp now, const CandidateParams& params, bool& cut_off) {
  const auto& [map, clearance_m, field, radius_m] = reach;
  std::vector<Candidate> candidates;
  for (const auto& [goal, id] : goals) {
    if (deferred.hold(goal.p_map, now)) continue;
    const grid::CellIndex at = map.cell_at(goal.p_map);
    auto cell = grid::nearest_to_stay_at(map, field, at, params.cell_reach_m);
    if (!cell && goal.side != goals::Side::kNone)
      cell = grid::end_of_way(map, clearance_m, field, at, radius_m, {params.unseen_way_m, 0.0});
    if (!cell) {
      cut_off = true;
      continue;
    }
    candidates.push_back({goal, id, *cell, way_cost_m(map, field, *cell, T_map_base, params)});
  }
  return candidates;
}

std::optional<goals::Goal> frontier_goal(const grid::DenseMap& map, const grid::TravelField& field,
                                         const goals::Frontier& frontier, const CandidateParams& params,
                                         double behind_min_m2) {
  const double behind_m2 = goals::unknown_behind_m2(map, frontier, params.pocket_reach_m);
  if (behind_m2 < behind_min_m2) return std::nullopt;
  const auto cell = goals::approach_cell(map, frontier, field, params.frontier_reach_m);
  if (!cell) return std::nullopt;
  goals::Goal goal;
  goal.p_map = map.centre_of(*cell);
  goal.opening = frontier.centroid;
  goal.opening_m = frontier.width_m;
  goal.behind_m2 = behind_m2;
  return goal;
}

const Candidate* successor_of(const goals::Goal& goal, std::span<const Candidate> candidates,
                              double successor_m) {
  const Candidate* best = nullptr;
  double best_m = successor_m;
  for (const Candidate& c : candidates) {
    const double moved_m =
        std::min((c.goal.p_map - goal.p_map).norm(), (c.goal.opening - goal.opening).norm());
    if (moved_m > best_m) continue;
    best_m = moved_m;
    best = &c;
  }
  return best;
}

double weighed_cost_m(const Candidate& candidate, const Candidate* present, double switch_gain) {
  return &candidate == present ? switch_gain * candidate.cost_m : candidate.cost_m;
}

const Candidate* choose(std::span<const Candidate> candidates, const Candidate* present, double switch_gain) {
  const auto cheapest =
      std::min_element(candidates.begin(), candidates.end(), [&](const Candidate& a, const Candidate& b) {
        return weighed_cost_m(a, present, switch_gain) < weighed_cost_m(b, present, switch_gain);
      });
  return cheapest == candidates.end() ? nullptr : &*cheapest;
}

}  // namespace topo::exploration
