// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/baselines.hpp"

#include <algorithm>

namespace topo::team {
namespace {

/// The number of other robots that are nearer to a goal; ties go to the lower row.
std::size_t position(const CostTable& table, std::size_t robot, std::size_t goal) {
  const double cost_m = table.cost_m(robot, goal);
  std::size_t nearer = 0;
  for (std::size_t other = 0; other < table.robots().size(); ++other) {
    if (other == robot) continue;
    const double other_m = table.cost_m(other, goal);
    if (other_m < cost_m || (other_m == cost_m && other < robot)) ++nearer;
  }
  return nearer;
}

/// P of the paper: the probability that one goal is seen from another.
double chance_to_see(double distance_m, double range_m) { return std::max(0.0, 1.0 - distance_m / range_m); }

}  // namespace

Assignment assign_in_turn(const CostTable& table) {
  Assignment assignment(table.robots().size());
  std::vector<bool> taken(table.goals().size(), false);
  for (std::size_t r = 0; r < assignment.size(); ++r) {
    double best_m = HUGE_VAL;
    for (std::size_t g = 0; g < taken.size(); ++g) {
      if (taken[g] || table.cost_m(r, g) >= best_m) continue;
      best_m = table.cost_m(r, g);
      assignment[r] = g;
    }
    if (assignment[r]) taken[*assignment[r]] = true;
  }
  return assignment;
}

Assignment assign_by_utility(const CostTable& table, const InSight& in_sight, double range_m) {
  Assignment assignment(table.robots().size());
  std::vector<double> utility(table.goals().size(), 1.0);
  for (std::size_t round = 0; round < assignment.size(); ++round) {
    double best = -HUGE_VAL;
    std::size_t robot = 0, goal = 0;
    for (std::size_t r = 0; r < assignment.size(); ++r) {
      for (std::size_t g = 0; g < utility.size() && !assignment[r]; ++g) {
        const double worth = utility[g] - table.cost_m(r, g) / range_m;
        if (worth <= best) continue;
        best = worth;
        robot = r;
        goal = g;
      }
    }
    if (std::isinf(best)) break;
    assignment[robot] = goal;
    for (std::size_t g = 0; g < utility.size(); ++g) {
      if (g == goal || in_sight(goal, g))
        utility[g] -= chance_to_see((table.goals()[g] - table.goals()[goal]).norm(), range_m);
    }
  }
  return assignment;
}

Assignment assign_min_pos(const CostTable& table) {
  Assignment assignment(table.robots().size());
  for (std::size_t r = 0; r < assignment.size(); ++r) {
    std::size_t least = 0;
    double best_m = HUGE_VAL;
    for (std::size_t g = 0; g < table.goals().size(); ++g) {
      const double cost_m = table.cost_m(r, g);
      if (std::isinf(cost_m)) continue;
      const std::size_t nearer = position(table, r, g);
      const bool better = !assignment[r] || nearer < least || (nearer == least && cost_m < best_m);
      if (!better) continue;
      least = nearer;
      best_m = cost_m;
      assignment[r] = g;
    }
  }
  return assignment;
}

}  // namespace topo::team
