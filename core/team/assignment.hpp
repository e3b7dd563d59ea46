// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/types/se2.hpp"

namespace topo::team {

/// The travel cost of each robot to each goal; HUGE_VAL where the robot cannot reach the goal or does not bid
/// for it.
class CostTable {
 public:
  /// Robots in the order of their ids, goals in the order of comes_before (k_means.hpp), each once: no rule
  /// can then depend on the order in which they became known.
  CostTable(std::vector<std::uint16_t> robots, std::vector<types::Vector2> goals);

  [[nodiscard]] const std::vector<std::uint16_t>& robots() const { return robots_; }
  [[nodiscard]] const std::vector<types::Vector2>& goals() const { return goals_; }
  [[nodiscard]] double& cost_m(std::size_t robot, std::size_t goal) {
    return cost_m_[robot * goals_.size() + goal];
  }
  [[nodiscard]] double cost_m(std::size_t robot, std::size_t goal) const {
    return cost_m_[robot * goals_.size() + goal];
  }
  /// The clusters are formed from the essential goals; every other goal joins the cluster of the nearest one.
  /// With fewer essential goals than able robots all goals count. Initially all are essential.
  [[nodiscard]] bool is_essential(std::size_t goal) const { return essential_[goal]; }
  void set_essential(std::size_t goal, bool essential) { essential_[goal] = essential; }
  /// The number of robots that can reach at least one goal.
  [[nodiscard]] std::size_t able_robots() const;

 private:
  std::vector<std::uint16_t> robots_;
  std::vector<types::Vector2> goals_;
  std::vector<double> cost_m_;
  std::vector<bool> essential_;
};

/// For each robot of a table the index of its goal; empty: the robot waits.
using Assignment = std::vector<std::optional<std::size_t>>;

/// Paper section II-F: k-means of the goals with k = the number of able robots when there are more goals,
/// else every goal is a cluster. The cheapest pair of robot and cluster is assigned and removed, repeatedly;
/// the cost of a pair is the robot's cost to its nearest goal in the cluster, and that is the goal the robot
/// gets. Ties: the lower robot, the earlier cluster. `clusters` false (ablation): every goal is a cluster.
Assignment assign_clusters(const CostTable& table, bool clusters = true);

/// The cluster of each goal, as used by assign_clusters.
std::vector<std::size_t> clusters_of(const CostTable& table, bool clusters = true);

}  // namespace topo::team
