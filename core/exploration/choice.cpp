// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/choice.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/exploration/tour.hpp"
#include "core/goals/filters.hpp"
#include "core/team/coordination.hpp"

namespace topo::exploration {
namespace {

using types::Vector2;

/// Expected information gain of a goal: the area behind it in m2. For a pocket this is its own area, for an
/// opening that leads on the mean area behind such openings.
double information_gain_m2(const goals::Goal& goal, const TourParams& params) {
  const double beyond_m2 = params.shadow_m2 + goal.chance * params.leads_on_m2;
  const double behind_m2 = std::isinf(goal.behind_m2) ? beyond_m2 : goal.behind_m2;
  return goal.side == goals::Side::kNone ? params.gap_share * behind_m2 : behind_m2;
}

TourGoals tour_goals(std::span<const Candidate* const> candidates, Searches searches,
                     const TourParams& params) {
  const travel::CoarseMap& coarse = searches.map.coarse();
  std::vector<grid::CellIndex> cells;
  for (const Candidate* c : candidates)
    cells.push_back(coarse.map.cell_at(searches.map.map().centre_of(c->cell)));
  searches.ways.update(coarse.map, coarse.clearance_m, searches.map.rules(), cells);
  TourGoals tour(candidates.size());
  for (std::size_t i = 0; i < tour.count; ++i) {
    tour.from_start_m[i] = candidates[i]->cost_m;
    tour.worth[i] = information_gain_m2(candidates[i]->goal, params);
    for (std::size_t j = 0; j < tour.count; ++j) {
      // A route through the robot's position always exists.
      tour.between(i, j) =
          i == j ? 0.0
                 : std::min(searches.ways.between_m(i, j), candidates[i]->cost_m + candidates[j]->cost_m);
    }
  }
  return tour;
}

}  // namespace

const Candidate* first_of_tour(std::vector<const Candidate*> candidates, const Candidate* present,
                               Searches searches, const TourParams& params) {
  if (candidates.empty()) return nullptr;
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate* a, const Candidate* b) { return a->cost_m < b->cost_m; });
  const std::size_t most = std::max<std::size_t>(params.goals_max, 1);
  if (candidates.size() > most) {
    const auto last = candidates.begin() + static_cast<std::ptrdiff_t>(most);
    if (std::find(last, candidates.end(), present) != candidates.end()) *(last - 1) = present;
    candidates.erase(last, candidates.end());
  }
  const TourGoals tour = tour_goals(candidates, searches, params);
  const double share = params.length_share;
  const Tour best = cheap_tour(tour, share);
  const auto at = std::find(candidates.begin(), candidates.end(), present);
  if (at == candidates.end() || candidates[best.front()] == present) return candidates[best.front()];
  const Tour kept = cheap_tour(tour, share, static_cast<std::size_t>(at - candidates.begin()));
  const double gain_m = tour_cost_m(tour, kept, share) - tour_cost_m(tour, best, share);
  return gain_m > params.switch_share * present->cost_m ? candidates[best.front()] : present;
}

Choice choose(std::span<const Candidate> candidates, const Candidate* present, double claimed_m,
              const Situation& situation, Searches searches, const ExplorationParams& params) {
  const StrategyRow& strategy = row_of(params.strategy);
  Choice choice;
  for (const Candidate& c : candidates) {
    choice.bids.push_back(
        team::in_steps({place_for_team(c.goal), weighed_cost_m(c, present, params.switch_gain),
                        c.goal.side != goals::Side::kNone}));
  }
  team::StatusMessage self;
  self.robot = situation.team.robot;
  self.bids = choice.bids;
  if (present != nullptr) self.claim = team::in_steps({place_for_team(present->goal), claimed_m, true});
  const grid::DenseMap& map = searches.map.map();
  const auto in_sight = [&](const Vector2& a, const Vector2& b) {
    return goals::sees(map, map.cell_at(a), map.cell_at(b));
  };
  const team::Chooser by_tour = [&](std::span<const std::size_t> share) {
    std::vector<const Candidate*> among;
    for (const std::size_t i : share) among.push_back(&candidates[i]);
    const Candidate* first = first_of_tour(std::move(among), present, searches, params.tour);
    return static_cast<std::size_t>(first - candidates.data());
  };
  const team::Rule rule = params.k_means ? strategy.rule : strategy.no_k_means;
  const auto chosen = team::coordinate(rule, self, situation.team.roster.counted(situation.now), in_sight,
                                       strategy.tours ? by_tour : team::Chooser{});
  if (chosen) choice.best = &candidates[*chosen];
  return choice;
}

}  // namespace topo::exploration
