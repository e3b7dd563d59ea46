// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/essential_goals.hpp"

#include <cassert>
#include <optional>

#include "core/goals/filters.hpp"
#include "core/goals/greedy_cover.hpp"
#include "core/goals/opening_chance.hpp"
#include "core/goals/openings.hpp"
#include "core/goals/space_behind.hpp"
#include "core/goals/standing_places.hpp"
#include "core/goals/steering.hpp"

namespace topo::goals {
namespace {

/// The candidate of an opening after the filters that judge it alone; `prospect` is set where it may become a
/// goal.
struct Candidate {
  Goal goal;
  std::optional<Prospect> prospect;
};

Candidate candidate_of(const GoalInput& input, const Opening& opening, const GoalParams& params,
                       FreeNodes& nodes) {
  Goal goal;
  goal.opening = goal.p_map = input.map.centre_of(input.map.cell(opening.middle));
  goal.opening_m = opening.width_m;
  goal.place = opening.place;
  goal.side = opening.side;
  goal.verdict = Verdict::kNoOpening;
  const SpaceBehind space = space_behind(input.map, opening.cells, input.continued, params.behind_m);
  if (space.area_m2 < params.behind_m2) return {goal, std::nullopt};
  const std::optional<grid::CellIndex> stand = nearest_room(input, opening.cells, params);
  if (!stand) return {goal, std::nullopt};
  goal.p_map = steer(input, opening, *stand, params, nodes);
  goal.verdict = is_visited(goal, input.visited, params) ? Verdict::kVisited : Verdict::kUnlikely;
  if (goal.verdict == Verdict::kVisited) return {goal, std::nullopt};
  goal.chance = chance_to_lead_on(space, params.behind_m);
  return {goal, Prospect{goal.p_map, *stand, goal.chance}};
}

/// The candidate of a side without an opening: rejected, with the reason, to explain why there is no goal.
Goal closed_side(const GoalInput& input, std::uint16_t place, Side side, const GoalParams& params) {
  Goal goal;
  goal.opening = goal.p_map = side_midpoint(input.places, place, side);
  goal.place = place;
  goal.side = side;
  goal.verdict = faces_another_place(input, place, side, params) ? Verdict::kInternal : Verdict::kNoOpening;
  return goal;
}

/// All candidates, by place and side.
std::vector<Candidate> candidates(const GoalInput& input, const GoalParams& params) {
  const std::vector<Opening> openings = find_openings(input, params);
  FreeNodes nodes(input.skeleton);
  std::vector<Candidate> all;
  auto opening = openings.begin();
  for (std::size_t p = 1; p <= input.places.places.size(); ++p) {
    const auto place = static_cast<std::uint16_t>(p);
    for (const Side side : {Side::kEast, Side::kNorth, Side::kWest, Side::kSouth}) {
      const auto first = opening;
      for (; opening != openings.end() && opening->place == place && opening->side == side; ++opening)
        all.push_back(candidate_of(input, *opening, params, nodes));
      if (first == opening) all.push_back({closed_side(input, place, side, params), std::nullopt});
    }
  }
  return all;
}

/// Accepts few candidates; from their viewpoints all openings with enough expected information gain are
/// served.
void accept_few(const GoalInput& input, std::vector<Candidate>& candidates, const GoalParams& params) {
  std::vector<Prospect> prospects;
  std::vector<Goal*> goals;
  for (Candidate& candidate : candidates) {
    if (!candidate.prospect) continue;
    prospects.push_back(*candidate.prospect);
    goals.push_back(&candidate.goal);
  }
  const std::vector<StandingPlace> places = standing_places(input, prospects, params);
  const GreedyCover cover = cover_openings(prospects, places, input.visited, params);
  for (std::size_t k = 0; k < goals.size(); ++k)
    if (cover.served[k]) goals[k]->verdict = Verdict::kServed;
  for (const Chosen& chosen : cover.chosen) {
    goals[chosen.prospect]->verdict = Verdict::kAccepted;
    goals[chosen.prospect]->p_map = places[chosen.place].p_map;
  }
}

}  // namespace

GoalSet essential_goals(const GoalInput& input, const GoalParams& params) {
  assert(input.clearance_m.size() == input.map.cells.size());
  std::vector<Candidate> all = candidates(input, params);
  accept_few(input, all, params);
  GoalSet out;
  for (const Candidate& candidate : all)
    (candidate.goal.verdict == Verdict::kAccepted ? out.goals : out.rejected).push_back(candidate.goal);
  return out;
}

}  // namespace topo::goals
