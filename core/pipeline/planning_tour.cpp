// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

// The order in which a robot means to visit its goals (core/goals/tour.hpp): it goes for the first of them. A
// goal that is near but leads away from all others waits; a gap on the way is filled in before the robot has
// to come back for it.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/exploration/tour.hpp"
#include "core/goals/opening_chance.hpp"
#include "core/goals/opening_check.hpp"
#include "core/grid/nearest_reachable.hpp"
#include "core/pipeline/planning_state.hpp"

namespace topo::pipeline {
namespace {

constexpr double kSameOpening_m = 2.0;  // a frontier so near to an essential goal's opening is that opening
constexpr double kSameStand_m = 1.0;
constexpr double kExact_m = 6.0;  // of the way; the costs of farther goals need not be exact
// Nobody waits for an answer while others explore.
constexpr types::Duration kAskAgain = std::chrono::seconds(1), kAskAgainMeanwhile = std::chrono::seconds(30);

/// Is there among the candidates one by whose `at` that point is?
bool is_beside(const types::Vector2& p_map, std::span<const exploration::Candidate> candidates,
               types::Vector2 goals::Goal::*at, double within_m) {
  return std::any_of(candidates.begin(), candidates.end(),
                     [&](const exploration::Candidate& c) { return (c.goal.*at - p_map).norm() < within_m; });
}

/// The area that may be behind it, m2: of a pocket that, of an opening that leads on what can be hoped for.
double worth_of(const goals::Goal& goal, const TourParams& params) {
  const double hoped_m2 = params.shadow_m2 + goal.chance * params.leads_on_m2;
  const double behind_m2 = std::isinf(goal.behind_m2) ? hoped_m2 : goal.behind_m2;
  return goal.side == goals::Side::kNone ? params.gap_share * behind_m2 : behind_m2;
}

}  // namespace

/// Essential goals, and gaps that are worth a look: all when the exploration is to be complete; else, when no
/// essential goal is left, those through which the building goes on all the same.
std::vector<exploration::Candidate> PlanningState::Impl::tour_candidates(const PlanningInput& in,
                                                                         bool& cut_off) {
  search.settle(kExact_m);
  cut_off = false;
  std::vector<goals::Frontier> frontiers = goals::find_frontiers(map, params.frontier_min_m);
  clusters = static_cast<int>(frontiers.size());
  std::vector<exploration::Candidate> candidates = candidates_among(in, analysis->goals.goals, cut_off);
  second_phase = candidates.empty();
  if (candidates.empty() && !returning && !cut_off) cut_off = is_unlikely_goal_cut_off(in);
  const bool complete = params.finish == Finish::kComplete;
  if (complete || second_phase) {
    if (!complete) leave_overlooked(frontiers);
    add_gaps(in, std::move(frontiers), candidates, cut_off);
  }
  const bool sweeps = looks_around() && !returning;
  if (sweeps) settle_looks(in);
  if (!candidates.empty()) {
    looks.interrupt(in.now);
    looks_meanwhile = false;
  } else if (sweeps && (!cut_off || looks_meanwhile)) {
    find_looks(in);
  }
  // A sweep that has begun goes on in one tour with what has come up: else the robot would leave a corner
  // that is at hand, and come back for it.
  if (sweeps) add_looks(candidates, cut_off);
  estimate_far_ones(candidates);
  return candidates;
}

/// An opening that is hardly worth a goal is worth a moment's patience all the same when its way is shut.
bool PlanningState::Impl::is_unlikely_goal_cut_off(const PlanningInput& in) const {
  std::vector<goals::Goal> unlikely;
  std::ranges::copy_if(analysis->goals.rejected, std::back_inserter(unlikely),
                       [](const goals::Goal& g) { return g.verdict == goals::Verdict::kUnlikely; });
  bool cut_off = false;
  (void)candidates_among(in, unlikely, cut_off);
  return cut_off;
}

/// The few goals that stand in for all others are gone, and something big may still be behind a door that one
/// of them was to show. Nobody goes home before that was looked at.
void PlanningState::Impl::leave_overlooked(std::vector<goals::Frontier>& frontiers) const {
  goals::GoalParams onto_much = params.analysis.goals;
  onto_much.behind_m2 = params.tour.overlooked_m2;
  std::erase_if(frontiers, [&](const goals::Frontier& frontier) {
    return !goals::leads_to_unknown(map, frontier.cells, onto_much);
  });
}

void PlanningState::Impl::add_gaps(const PlanningInput& in, std::vector<goals::Frontier> frontiers,
                                   std::vector<exploration::Candidate>& candidates, bool& cut_off) const {
  std::erase_if(frontiers, [&](const goals::Frontier& frontier) {
    return is_beside(frontier.centroid, candidates, &goals::Goal::opening, kSameOpening_m);
  });
  std::vector<exploration::Candidate> gaps = gap_candidates(in, frontiers, params.tour.pocket_m2, cut_off);
  std::erase_if(gaps, [&](const exploration::Candidate& gap) {
    return is_beside(gap.goal.p_map, candidates, &goals::Goal::p_map, kSameStand_m);
  });
  const auto leads_on = [](const exploration::Candidate& gap) { return std::isinf(gap.goal.behind_m2); };
  if (std::ranges::any_of(gaps, leads_on)) {
    const std::vector<std::vector<types::Vector2>> paths = driven_paths(*in.map);
    for (exploration::Candidate& gap : gaps) {
      if (!leads_on(gap)) continue;
      const double from_paths_m = goals::distance_from_paths_m(gap.goal.opening, paths);
      gap.goal.chance = goals::chance_to_lead_on(gap.goal.opening_m, from_paths_m);
    }
  }
  candidates.insert(candidates.end(), gaps.begin(), gaps.end());
}

bool PlanningState::Impl::looks_around() const {
  return params.finish == Finish::kComplete && params.strategy == exploration::Strategy::kTopometric;
}

/// What is still open after a visit cannot be seen from there. Last looks find from where it can; without
/// them a second visit is all that is left to do.
std::optional<types::Stamp> PlanningState::Impl::next_visit(types::Stamp now) const {
  if (looks_around()) return std::nullopt;
  return now + types::from_seconds(params.visited_s);
}

void PlanningState::Impl::settle_looks(const PlanningInput& in) {
  looks.settle(map, in.now);
  for (const team::StatusMessage* mate : roster.heard(in.now)) looks.share(mate->looked);
}

/// When there is nothing else to do.
void PlanningState::Impl::find_looks(const PlanningInput& in) {
  const bool is_awaited = in.team == nullptr || !others_have_goals(in);
  looks.find({map, map_revision, known_m2, field, analysis->walls}, in.now,
             is_awaited ? kAskAgain : kAskAgainMeanwhile);
}

/// Those that were found and are not taken yet.
void PlanningState::Impl::add_looks(std::vector<exploration::Candidate>& candidates, bool& cut_off) const {
  // A look from beside a goal that a robot was at shows something else.
  const exploration::DeferredGoals none;
  std::vector<exploration::Candidate> found =
      exploration::candidates_of(looks.goals(), {map, clearance.clearance_m(), field, params.travel.radius_m},
                                 none, T_map_base.se2(), {}, cut_off);
  const std::size_t all = found.size();
  std::erase_if(found, [&](const exploration::Candidate& c) {
    return (map.centre_of(c.cell) - c.goal.p_map).norm() > looks.reached_m();
  });
  cut_off = cut_off || found.size() < all;
  candidates.insert(candidates.end(), found.begin(), found.end());
}

/// Candidates that the fine search has not come to get the costs of the coarse map.
void PlanningState::Impl::estimate_far_ones(std::vector<exploration::Candidate>& candidates) {
  constexpr double kReach_m = 0.6;
  struct FarOne {
    exploration::Candidate* candidate;
    std::optional<grid::CellIndex> coarse_cell;
  };
  std::vector<FarOne> far;
  for (exploration::Candidate& c : candidates) {
    if (static_cast<double>(field.cost_m[map.index(c.cell)]) >= search.settled_m()) far.push_back({&c, {}});
  }
  if (far.empty()) return;
  need_coarse();
  for (FarOne& one : far) {
    const grid::CellIndex beside = coarse.map.cell_at(map.centre_of(one.candidate->cell));
    one.coarse_cell = grid::nearest_reachable(coarse.map, coarse_field, beside, kReach_m);
  }
  // Where one has a way on the fine map alone, that map has to tell of all.
  const bool tells =
      std::all_of(far.begin(), far.end(), [](const FarOne& one) { return one.coarse_cell.has_value(); });
  if (!tells) search.settle(HUGE_VAL);
  for (const auto& [candidate, coarse_cell] : far)
    candidate->cost_m =
        tells ? exploration::way_cost_m(coarse.map, coarse_field, *coarse_cell, T_map_base.se2())
              : exploration::way_cost_m(map, field, candidate->cell, T_map_base.se2());
}

exploration::TourGoals PlanningState::Impl::tour_goals(
    std::span<const exploration::Candidate* const> candidates) {
  need_coarse();
  std::vector<grid::CellIndex> cells;
  for (const exploration::Candidate* c : candidates)
    cells.push_back(coarse.map.cell_at(map.centre_of(c->cell)));
  goal_ways.update(coarse.map, coarse.clearance_m, params.travel, cells);
  exploration::TourGoals tour(candidates.size());
  for (std::size_t i = 0; i < tour.count; ++i) {
    tour.from_start_m[i] = candidates[i]->cost_m;
    tour.worth[i] = worth_of(candidates[i]->goal, params.tour);
    for (std::size_t j = 0; j < tour.count; ++j) {
      // There is always the way by where the robot is.
      tour.between(i, j) =
          i == j ? 0.0 : std::min(goal_ways.between_m(i, j), candidates[i]->cost_m + candidates[j]->cost_m);
    }
  }
  return tour;
}

const exploration::Candidate* PlanningState::Impl::first_of_tour(
    std::vector<const exploration::Candidate*> candidates, const exploration::Candidate* present) {
  if (candidates.empty()) return nullptr;
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const exploration::Candidate* a, const exploration::Candidate* b) { return a->cost_m < b->cost_m; });
  const std::size_t most = std::max<std::size_t>(params.tour.goals_max, 1);
  if (candidates.size() > most) {
    const auto last = candidates.begin() + static_cast<std::ptrdiff_t>(most);
    if (std::find(last, candidates.end(), present) != candidates.end()) *(last - 1) = present;
    candidates.erase(last, candidates.end());
  }
  const exploration::TourGoals tour = tour_goals(candidates);
  const double share = params.tour.length_share;
  const exploration::Tour best = exploration::cheap_tour(tour, share);
  const auto at = std::find(candidates.begin(), candidates.end(), present);
  if (at == candidates.end() || candidates[best.front()] == present) return candidates[best.front()];
  const exploration::Tour kept =
      exploration::cheap_tour(tour, share, static_cast<std::size_t>(at - candidates.begin()));
  const double gain_m =
      exploration::tour_cost_m(tour, kept, share) - exploration::tour_cost_m(tour, best, share);
  return gain_m > params.tour.switch_share * present->cost_m ? candidates[best.front()] : present;
}

}  // namespace topo::pipeline
