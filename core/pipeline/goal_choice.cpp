// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/goal_choice.hpp"

#include <algorithm>
#include <cmath>

#include "core/goals/frontiers.hpp"

namespace topo::pipeline {
namespace {

constexpr double kGoalReach_m = 0.6;      // a goal whose own cell is closed by what stands there now
constexpr double kFrontierReach_m = 1.0;  // a frontier is seen from this near
constexpr double kSuccessor_m = 2.5;      // how far a goal may move from one map to the next and be the same

}  // namespace

std::vector<Candidate> candidates_of(std::span<const goals::Goal> goals, const grid::DenseMap& map,
                                     const grid::TravelField& field, const GivenUpGoals& given_up,
                                     types::Stamp now, int& unreachable) {
  std::vector<Candidate> candidates;
  for (const goals::Goal& goal : goals) {
    if (given_up.hold(goal.p_map, now)) continue;
    const auto cell = grid::nearest_reachable(map, field, map.cell_at(goal.p_map), kGoalReach_m);
    if (!cell) {
      ++unreachable;
      continue;
    }
    candidates.push_back({goal, *cell, static_cast<double>(field.cost_m[map.index(*cell)])});
  }
  return candidates;
}

std::vector<goals::Goal> frontier_goals(const grid::DenseMap& map, const grid::TravelField& field,
                                        double width_min_m, int& clusters) {
  std::vector<goals::Goal> found;
  const std::vector<goals::Frontier> frontiers = goals::find_frontiers(map, width_min_m);
  clusters = static_cast<int>(frontiers.size());
  for (const goals::Frontier& frontier : frontiers) {
    const auto cell = goals::approach_cell(map, frontier, field, kFrontierReach_m);
    if (!cell) continue;
    goals::Goal goal;
    goal.p_map = map.centre_of(*cell);
    goal.opening = frontier.centroid;
    goal.opening_m = frontier.width_m;
    found.push_back(goal);
  }
  return found;
}

const Candidate* successor_of(const goals::Goal& goal, std::span<const Candidate> candidates) {
  const Candidate* best = nullptr;
  double best_m = kSuccessor_m;
  for (const Candidate& c : candidates) {
    const double moved_m =
        std::min((c.goal.p_map - goal.p_map).norm(), (c.goal.opening - goal.opening).norm());
    if (moved_m > best_m) continue;
    best_m = moved_m;
    best = &c;
  }
  return best;
}

const Candidate* choose(std::span<const Candidate> candidates, const Candidate* present, double switch_gain,
                        std::uint16_t home_place) {
  const Candidate* best = nullptr;
  double best_m = HUGE_VAL;
  for (const Candidate& c : candidates) {
    double cost_m = c.cost_m;
    if (&c == present) cost_m *= switch_gain;
    if (home_place != 0 && c.goal.place == home_place) cost_m *= 0.5;
    if (cost_m >= best_m) continue;
    best_m = cost_m;
    best = &c;
  }
  return best;
}

}  // namespace topo::pipeline
