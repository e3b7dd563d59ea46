// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/loop_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

namespace topo::slam {
namespace {

double distance(const types::Se2& a, const types::Se2& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

/// Metres of the shortest way through the graph from a node to every other (Dijkstra): what drift grows with.
std::vector<double> graph_distances(std::size_t nodes, std::span<const Edge> edges, std::size_t from) {
  std::vector<std::vector<std::pair<std::size_t, double>>> links(nodes);
  for (const Edge& edge : edges) {
    const double length = std::hypot(edge.T_from_to.x_m, edge.T_from_to.y_m) + 0.05;
    links[edge.from].emplace_back(edge.to, length);
    links[edge.to].emplace_back(edge.from, length);
  }
  std::vector<double> best(nodes, HUGE_VAL);
  using Item = std::pair<double, std::size_t>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  best[from] = 0.0;
  queue.emplace(0.0, from);
  while (!queue.empty()) {
    const auto [d, at] = queue.top();
    queue.pop();
    if (d > best[at]) continue;
    for (const auto& [next, length] : links[at]) {
      if (d + length < best[next]) {
        best[next] = d + length;
        queue.emplace(best[next], next);
      }
    }
  }
  return best;
}

SearchWindow window_for(double graph_distance, const LoopParams& params) {
  return {std::min(params.search_max_m, params.search_floor_m + params.drift_per_m * graph_distance),
          std::min(params.search_max_rad, params.search_floor_rad + params.drift_per_m_rad * graph_distance)};
}

LoopRun around(std::size_t nearest, std::size_t last_allowed, const LoopParams& params) {
  const auto half = static_cast<std::size_t>(params.group_half);
  LoopRun run;
  run.nearest = nearest;
  run.first = nearest > half ? nearest - half : 0;
  run.last = std::min(nearest + half, last_allowed);
  return run;
}

}  // namespace

std::vector<LoopRun> find_loop_runs(std::span<const types::Se2> poses, std::span<const Edge> edges,
                                    std::size_t node, const LoopParams& params) {
  // The last node of "another visit": the path since is longer than the gap.
  double travelled = 0.0;
  std::size_t last = node;
  while (last > 0 && travelled < params.chain_gap_m) {
    travelled += distance(poses[last], poses[last - 1]);
    --last;
  }
  if (travelled < params.chain_gap_m) return {};

  const std::vector<double> graph = graph_distances(poses.size(), edges, node);
  struct Near {
    double distance_m;
    LoopRun run;
  };
  std::vector<Near> runs;
  std::size_t previous = 0;
  bool open = false;
  for (std::size_t i = 0; i <= last; ++i) {
    const double d = distance(poses[i], poses[node]);
    const SearchWindow window = window_for(graph[i], params);
    if (d > params.radius_m + window.half_m) continue;
    if (!open || i > previous + 3) runs.push_back({HUGE_VAL, {}});
    open = true;
    previous = i;
    if (d < runs.back().distance_m) {
      runs.back() = {d, around(i, last, params)};
      runs.back().run.window = window;
    }
  }
  std::stable_sort(runs.begin(), runs.end(),
                   [](const Near& a, const Near& b) { return a.distance_m < b.distance_m; });
  std::vector<LoopRun> out;
  for (const Near& near : runs) {
    if (out.size() == static_cast<std::size_t>(params.groups_max)) break;
    out.push_back(near.run);
  }
  return out;
}

}  // namespace topo::slam
