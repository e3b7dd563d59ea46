// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/shares.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace topo::team {
namespace {

/// Travel from where a robot is, or is going, whichever is nearer. What lies at its own goal it will see from
/// there, also when it does not bid for it yet.
double away_m(const SharedGoals& goals, std::size_t row, std::size_t goal) {
  const double cost_m = goals.table.cost_m(row, goal);
  const auto& claim = goals.claims[row];
  return claim ? std::min(cost_m, goals.between_m(*claim, goal)) : cost_m;
}

/// The robot whose each goal is.
std::vector<std::size_t> nearest_robots(const SharedGoals& goals) {
  std::vector<std::size_t> nearest(goals.table.goals().size(), 0);
  for (std::size_t goal = 0; goal < nearest.size(); ++goal) {
    double best_m = away_m(goals, 0, goal);
    for (std::size_t row = 1; row < goals.table.robots().size(); ++row) {
      const double row_m = away_m(goals, row, goal);
      if (row_m < best_m) {
        best_m = row_m;
        nearest[goal] = row;
      }
    }
  }
  return nearest;
}

/// Travel after which a robot is at each of its goals, `own`, when from its claim on it always takes the
/// nearest. Between two of them it drives no farther than by way of where it is.
std::vector<double> arrivals_m(const SharedGoals& goals, std::size_t row, std::vector<std::size_t> own) {
  const CostTable& table = goals.table;
  std::vector<double> arrivals_m(table.goals().size(), HUGE_VAL);
  std::optional<std::size_t> at = goals.claims[row];
  double driven_m = 0.0;
  if (at) {
    arrivals_m[*at] = driven_m = table.cost_m(row, *at);
    std::erase(own, *at);
  }
  const auto leg_m = [&](std::size_t goal) {
    if (!at) return table.cost_m(row, goal);
    return std::min(goals.between_m(*at, goal), table.cost_m(row, *at) + table.cost_m(row, goal));
  };
  while (!own.empty()) {
    const std::size_t next = *std::ranges::min_element(own, {}, leg_m);
    driven_m += leg_m(next);
    arrivals_m[next] = driven_m;
    at = next;
    std::erase(own, next);
  }
  return arrivals_m;
}

std::vector<std::size_t> goals_of_row(const std::vector<std::size_t>& nearest, std::size_t row) {
  std::vector<std::size_t> own;
  for (std::size_t goal = 0; goal < nearest.size(); ++goal)
    if (nearest[goal] == row) own.push_back(goal);
  return own;
}

std::optional<std::size_t> help(const SharedGoals& goals, const std::vector<std::size_t>& nearest,
                                std::size_t row) {
  std::vector<double> others_m(nearest.size(), HUGE_VAL);
  for (std::size_t mate = 0; mate < goals.table.robots().size(); ++mate) {
    if (mate == row) continue;
    const std::vector<double> mates_m = arrivals_m(goals, mate, goals_of_row(nearest, mate));
    for (std::size_t goal = 0; goal < others_m.size(); ++goal)
      others_m[goal] = std::min(others_m[goal], mates_m[goal]);
  }
  std::optional<std::size_t> best;
  double most_m = 0.0;
  for (std::size_t goal = 0; goal < others_m.size(); ++goal) {
    const double cost_m = goals.table.cost_m(row, goal);
    const double before_m = goals.tours_grow * others_m[goal] - cost_m;
    if (cost_m == HUGE_VAL || !(before_m > most_m)) continue;
    most_m = before_m;
    best = goal;
  }
  return best;
}

}  // namespace

std::vector<std::size_t> share_of_goals(const SharedGoals& goals, std::size_t row) {
  const std::vector<std::size_t> nearest = nearest_robots(goals);
  std::vector<std::size_t> share = goals_of_row(nearest, row);
  std::erase_if(share, [&](std::size_t goal) { return goals.table.cost_m(row, goal) == HUGE_VAL; });
  if (!share.empty()) return share;
  if (const auto helps = help(goals, nearest, row)) share.push_back(*helps);
  return share;
}

}  // namespace topo::team
