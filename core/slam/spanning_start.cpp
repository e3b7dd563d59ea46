// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/spanning_start.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

namespace topo::slam {
namespace {

bool successive(const Edge& edge) { return std::max(edge.from, edge.to) - std::min(edge.from, edge.to) == 1; }

/// Indices of the edges at each node.
std::vector<std::vector<std::size_t>> edges_at_nodes(std::size_t nodes, std::span<const Edge> edges) {
  std::vector<std::vector<std::size_t>> at(nodes);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    at[edges[i].from].push_back(i);
    at[edges[i].to].push_back(i);
  }
  return at;
}

}  // namespace

std::optional<std::vector<types::Se2>> spanning_start(std::size_t nodes, std::span<const Edge> edges,
                                                      std::span<const int> ranks, const types::Se2& first) {
  // Prim's algorithm; the weight of an edge is its rank, then its index.
  using Weight = std::pair<int, std::size_t>;
  std::priority_queue<Weight, std::vector<Weight>, std::greater<>> open;
  const auto at_nodes = edges_at_nodes(nodes, edges);
  std::vector<types::Se2> poses(nodes);
  std::vector<bool> placed(nodes, false);
  std::size_t count = 0;
  const auto place = [&](std::size_t node, const types::Se2& pose) {
    poses[node] = pose;
    placed[node] = true;
    ++count;
    for (const std::size_t i : at_nodes[node]) open.emplace(ranks[i], i);
  };
  if (nodes > 0) place(0, first);
  while (!open.empty() && count < nodes) {
    const Edge& edge = edges[open.top().second];
    open.pop();
    if (placed[edge.from] && placed[edge.to]) continue;
    if (placed[edge.from])
      place(edge.to, poses[edge.from] * edge.T_from_to);
    else
      place(edge.from, poses[edge.to] * edge.T_from_to.inverse());
  }
  if (count < nodes) return std::nullopt;
  return poses;
}

std::optional<std::vector<types::Se2>> spanning_start(std::size_t nodes, std::span<const Edge> edges,
                                                      const types::Se2& first) {
  std::vector<int> ranks;
  ranks.reserve(edges.size());
  for (const Edge& edge : edges) ranks.push_back(successive(edge) ? 0 : 1);
  return spanning_start(nodes, edges, ranks, first);
}

}  // namespace topo::slam
