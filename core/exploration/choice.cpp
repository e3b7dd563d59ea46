// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/choice.hpp"

#include <algorithm>
#include <memory>
#include <optional>

#include "core/goals/filters.hpp"
#include "core/team/coordination.hpp"

namespace topo::exploration {
namespace {

using types::Vector2;

/// The first goal of a tour, or the present one when that costs little more.
std::size_t first_of(const TourGoals& goals, std::optional<std::size_t> present, const TourParams& params) {
  const double share = params.length_share;
  const Tour best = cheap_tour(goals, share);
  if (!present || best.front() == *present) return best.front();
  const Tour kept = cheap_tour(goals, share, present);
  const double gain_m = tour_cost_m(goals, kept, share) - tour_cost_m(goals, best, share);
  return gain_m > params.switch_share * goals.from_start_m[*present] ? best.front() : *present;
}

/// A pocket beside the way to `first` that costs little now against coming back for it; else `first`.
std::size_t beside_the_way(const TourGoals& goals, std::span<const bool> is_pocket, std::size_t first,
                           double now_share) {
  std::size_t chosen = first;
  for (std::size_t i = 0; i < goals.count; ++i) {
    if (!is_pocket[i] || i == first) continue;
    const double detour_m = goals.from_start_m[i] + goals.between(i, first) - goals.from_start_m[first];
    const double later_m = 2.0 * goals.between(first, i);
    if (detour_m > now_share * later_m) continue;
    if (chosen == first || goals.from_start_m[i] < goals.from_start_m[chosen]) chosen = i;
  }
  return chosen;
}

/// Index of the candidate for a goal of the team; none when it is nobody's here.
std::optional<std::size_t> candidate_for(const Vector2& goal, std::span<const Candidate> candidates) {
  const auto away_m = [&](const Candidate& c) { return (place_for_team(c.goal) - goal).norm(); };
  const auto nearest = std::ranges::min_element(candidates, {}, away_m);
  if (nearest == candidates.end() || away_m(*nearest) > team::kSameGoal_m) return std::nullopt;
  return static_cast<std::size_t>(nearest - candidates.begin());
}

}  // namespace

std::size_t first_of_tour(std::span<const std::size_t> share, const Alternatives& among,
                          const TourParams& params) {
  std::vector<std::size_t> rows, of;
  std::optional<std::size_t> present;
  for (const std::size_t i : share) {
    if (!among.table.row[i]) continue;
    if (&among.candidates[i] == among.present) present = of.size();
    rows.push_back(*among.table.row[i]);
    of.push_back(i);
  }
  if (of.empty())
    return *std::ranges::min_element(share, {}, [&](std::size_t i) { return among.candidates[i].cost_m; });
  TourGoals goals = rows_of(among.table.goals, rows);
  std::ranges::fill(goals.to_home_m, 0.0);  // what is open now is not all that there will be
  const std::size_t first = first_of(goals, present, params);
  const auto is_pocket = std::make_unique<bool[]>(of.size());
  for (std::size_t k = 0; k < of.size(); ++k)
    is_pocket[k] = among.candidates[of[k]].goal.side == goals::Side::kNone;
  return of[beside_the_way(goals, {is_pocket.get(), of.size()}, first, params.now_share)];
}

Choice choose(const Alternatives& among, const Situation& situation, const travel::RouteMap& map,
              const ExplorationParams& params) {
  const auto& [candidates, table, present, claimed_m] = among;
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
  if (present != nullptr) self.claim = claim_on(present->goal, claimed_m);
  const auto in_sight = [&](const Vector2& a, const Vector2& b) {
    return goals::sees(map.map(), map.map().cell_at(a), map.map().cell_at(b));
  };
  const auto between_m = [&](const Vector2& a, const Vector2& b) {
    const auto from = candidate_for(a, among.candidates), to = candidate_for(b, among.candidates);
    const auto& row = among.table.row;
    if (from && to && row[*from] && row[*to]) return among.table.goals.between(*row[*from], *row[*to]);
    return (a - b).norm();
  };
  const team::Chooser by_tour = [&](std::span<const std::size_t> share) {
    return first_of_tour(share, among, params.tour);
  };
  const auto chosen = team::coordinate(params.rule.value_or(strategy.rule), self,
                                       situation.team.roster.counted(situation.now), {in_sight, between_m},
                                       strategy.tours ? by_tour : team::Chooser{});
  if (chosen) choice.best = &candidates[*chosen];
  return choice;
}

}  // namespace topo::exploration
