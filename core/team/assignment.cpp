// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/assignment.hpp"

#include <algorithm>
#include <utility>

#include "core/team/k_means.hpp"

namespace topo::team {
namespace {

/// The nearest goal of a cluster for one robot.
struct Nearest {
  std::size_t goal = 0;
  double cost_m = HUGE_VAL;
};

std::vector<Nearest> nearest_of_clusters(const CostTable& table, std::size_t robot,
                                         const std::vector<std::size_t>& cluster, std::size_t clusters) {
  std::vector<Nearest> nearest(clusters);
  for (std::size_t goal = 0; goal < cluster.size(); ++goal) {
    Nearest& n = nearest[cluster[goal]];
    if (table.cost_m(robot, goal) < n.cost_m) n = {goal, table.cost_m(robot, goal)};
  }
  return nearest;
}

}  // namespace

CostTable::CostTable(std::vector<std::uint16_t> robots, std::vector<types::Vector2> goals)
    : robots_(std::move(robots)),
      goals_(std::move(goals)),
      cost_m_(robots_.size() * goals_.size(), HUGE_VAL),
      essential_(goals_.size(), true) {}

std::size_t CostTable::able_robots() const {
  std::size_t able = 0;
  for (std::size_t r = 0; r < robots_.size(); ++r) {
    const auto row = cost_m_.begin() + static_cast<std::ptrdiff_t>(r * goals_.size());
    if (std::any_of(row, row + static_cast<std::ptrdiff_t>(goals_.size()),
                    [](double cost_m) { return cost_m < HUGE_VAL; }))
      ++able;
  }
  return able;
}

std::vector<std::size_t> clusters_of(const CostTable& table, bool clusters) {
  const std::vector<types::Vector2>& goals = table.goals();
  // Single goals; a robot alone has nothing to share out, and one cluster holds all.
  if (!clusters) return k_means(goals, table.robots().size() > 1 ? goals.size() : 1);
  const std::size_t k = table.able_robots();
  std::vector<types::Vector2> essential;
  for (std::size_t goal = 0; goal < goals.size(); ++goal)
    if (table.is_essential(goal)) essential.push_back(goals[goal]);
  if (essential.size() < k) return k_means(goals, k);
  const std::vector<std::size_t> label = k_means(essential, k);
  std::vector<std::size_t> cluster;
  for (const types::Vector2& p : goals) {
    const auto nearest = std::min_element(
        essential.begin(), essential.end(),
        [&](const auto& a, const auto& b) { return (a - p).squaredNorm() < (b - p).squaredNorm(); });
    cluster.push_back(label[static_cast<std::size_t>(nearest - essential.begin())]);
  }
  return cluster;
}

Assignment assign_clusters(const CostTable& table, bool clusters) {
  Assignment assignment(table.robots().size());
  const std::size_t able = table.able_robots();
  if (able == 0) return assignment;
  const std::vector<std::size_t> cluster = clusters_of(table, clusters);
  const std::size_t count = 1 + *std::max_element(cluster.begin(), cluster.end());
  std::vector<std::vector<Nearest>> nearest;
  for (std::size_t r = 0; r < assignment.size(); ++r)
    nearest.push_back(nearest_of_clusters(table, r, cluster, count));
  std::vector<bool> taken(count, false);
  for (std::size_t round = 0; round < std::min(able, count); ++round) {
    double best_m = HUGE_VAL;
    std::size_t robot = 0, best = 0;
    for (std::size_t r = 0; r < assignment.size(); ++r) {
      for (std::size_t c = 0; c < count && !assignment[r]; ++c) {
        if (taken[c] || nearest[r][c].cost_m >= best_m) continue;
        best_m = nearest[r][c].cost_m;
        robot = r;
        best = c;
      }
    }
    if (std::isinf(best_m)) break;
    assignment[robot] = nearest[robot][best].goal;
    taken[best] = true;
  }
  return assignment;
}

}  // namespace topo::team
