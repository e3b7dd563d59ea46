// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/graph_links.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>

namespace topo::slam {

void GraphLinks::add(const Edge& edge, double loose_m) {
  const double length = std::hypot(edge.T_from_to.x_m, edge.T_from_to.y_m) + turn_on_spot_m_ + loose_m;
  at_.resize(std::max({at_.size(), edge.from + 1, edge.to + 1}));
  at_[edge.from].emplace_back(edge.to, length);
  at_[edge.to].emplace_back(edge.from, length);
}

/// Dijkstra's algorithm.
std::vector<double> GraphLinks::distances_m(std::size_t nodes, std::size_t from) const {
  std::vector<double> best(std::max(nodes, at_.size()), HUGE_VAL);
  using Item = std::pair<double, std::size_t>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  best[from] = 0.0;
  queue.emplace(0.0, from);
  while (!queue.empty()) {
    const auto [d, node] = queue.top();
    queue.pop();
    if (d > best[node] || node >= at_.size()) continue;
    for (const auto& [next, length] : at_[node]) {
      if (d + length < best[next]) {
        best[next] = d + length;
        queue.emplace(best[next], next);
      }
    }
  }
  return best;
}

}  // namespace topo::slam
