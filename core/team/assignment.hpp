// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/types/se2.hpp"

namespace topo::team {

/// What it costs each robot to get to each goal; HUGE_VAL where it cannot or does not want to.
class CostTable {
 public:
  /// Robots in the order of their ids, goals in the order of comes_before (k_means.hpp), each once: then no
  /// rule can depend on the order in which they became known.
  CostTable(std::vector<std::uint16_t> robots, std::vector<types::Vector2> goals);

  [[nodiscard]] const std::vector<std::uint16_t>& robots() const { return robots_; }
  [[nodiscard]] const std::vector<types::Vector2>& goals() const { return goals_; }
  [[nodiscard]] double& cost_m(std::size_t robot, std::size_t goal) {
    return cost_m_[robot * goals_.size() + goal];
  }
  [[nodiscard]] double cost_m(std::size_t robot, std::size_t goal) const {
    return cost_m_[robot * goals_.size() + goal];
  }
  /// Goals that the clusters are made of; the others join the nearest one's. All of them at first.
  [[nodiscard]] bool is_essential(std::size_t goal) const { return essential_[goal]; }
  void set_essential(std::size_t goal, bool essential) { essential_[goal] = essential; }
  /// How many robots have a goal that they could go to.
  [[nodiscard]] std::size_t able_robots() const;

 private:
  std::vector<std::uint16_t> robots_;
  std::vector<types::Vector2> goals_;
  std::vector<double> cost_m_;
  std::vector<bool> essential_;
};

/// For each robot of a table the index of its goal; nothing: it waits.
using Assignment = std::vector<std::optional<std::size_t>>;

/// Paper section II-F: k-means of the goals with k = the number of able robots when there are more goals,
/// else every goal is a cluster. The cheapest pair of robot and cluster, by the robot's cost to its nearest
/// goal there, is taken, both are out, and so on; a robot goes to that nearest goal. Ties: the lower robot,
/// the earlier cluster. `clusters` false: every goal is one of its own, the ablation.
Assignment assign_clusters(const CostTable& table, bool clusters = true);

/// The cluster of each goal, as assign_clusters has them.
std::vector<std::size_t> clusters_of(const CostTable& table, bool clusters = true);

}  // namespace topo::team
