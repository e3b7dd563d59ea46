// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/essential_goals.hpp"

#include <algorithm>
#include <cassert>

#include "core/goals/filters.hpp"
#include "core/goals/opening_check.hpp"
#include "core/goals/openings.hpp"
#include "core/goals/steering.hpp"

namespace topo::goals {
namespace {

Goal goal_of(const GoalInput& input, const Opening& opening, const GoalParams& params, FreeNodes& nodes) {
  Goal goal;
  goal.opening = goal.p_map = input.map.centre_of(input.map.cell(opening.middle));
  goal.opening_m = opening.width_m;
  goal.place = opening.place;
  goal.side = opening.side;
  const bool leads = leads_to_unknown(input.map, opening.cells, params);
  const auto p = leads ? steer(input, opening, params, nodes) : std::nullopt;
  if (p) goal.p_map = *p;
  if (!p) goal.verdict = Verdict::kNoOpening;
  return goal;
}

/// A side without an opening: kept with the reason, for who asks why there is no goal.
Goal closed_side(const GoalInput& input, std::uint16_t place, Side side) {
  Goal goal;
  goal.opening = goal.p_map = side_midpoint(input.places, place, side);
  goal.place = place;
  goal.side = side;
  goal.verdict = faces_another_place(input, place, side) ? Verdict::kInternal : Verdict::kNoOpening;
  return goal;
}

/// All candidates, by place and side; what has no opening or no room already judged.
std::vector<Goal> candidates(const GoalInput& input, const GoalParams& params) {
  const std::vector<Opening> openings = find_openings(input, params);
  FreeNodes nodes(input.skeleton);
  std::vector<Goal> all;
  auto opening = openings.begin();
  for (std::size_t p = 1; p <= input.places.places.size(); ++p) {
    const auto place = static_cast<std::uint16_t>(p);
    for (const Side side : {Side::kEast, Side::kNorth, Side::kWest, Side::kSouth}) {
      const auto first = opening;
      for (; opening != openings.end() && opening->place == place && opening->side == side; ++opening)
        all.push_back(goal_of(input, *opening, params, nodes));
      if (first == opening) all.push_back(closed_side(input, place, side));
    }
  }
  return all;
}

/// Moves what is still accepted of one place to the front of its range.
std::span<Goal> accepted_of(std::vector<Goal>& goals, std::vector<Goal>::iterator begin,
                            std::vector<Goal>::iterator end) {
  const auto middle =
      std::stable_partition(begin, end, [](const Goal& g) { return g.verdict == Verdict::kAccepted; });
  return std::span(goals).subspan(static_cast<std::size_t>(begin - goals.begin()),
                                  static_cast<std::size_t>(middle - begin));
}

}  // namespace

GoalSet essential_goals(const GoalInput& input, const GoalParams& params) {
  assert(input.clearance_m.size() == input.map.cells.size());
  std::vector<Goal> all = candidates(input, params);
  for (Goal& goal : all) {
    if (goal.verdict == Verdict::kAccepted && is_visited(goal, input.visited, params))
      goal.verdict = Verdict::kVisited;
  }
  // The paper asks for the pose history last. Here it comes before the comparison of a place's goals: one
  // that a robot has been at must not make another one of the same place give way.
  for (auto begin = all.begin(); begin != all.end();) {
    const auto end = std::find_if(begin, all.end(), [&](const Goal& g) { return g.place != begin->place; });
    drop_near_centroid(input.places, accepted_of(all, begin, end), params);
    begin = end;
  }
  drop_duplicates(input.map, all, params);
  GoalSet out;
  for (const Goal& goal : all)
    (goal.verdict == Verdict::kAccepted ? out.goals : out.rejected).push_back(goal);
  return out;
}

}  // namespace topo::goals
