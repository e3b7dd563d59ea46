// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/canonical_map.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "core/slam/graph_solution.hpp"
#include "core/slam/odometry_evidence.hpp"
#include "core/slam/spanning_start.hpp"

namespace topo::slam {
namespace {

/// The keys that relations connect to the origin, in order.
std::vector<KeyframeId> tied_to(const KeyframeId& origin, const KeyframeSet& keyframes,
                                const RelationSet& relations) {
  std::map<KeyframeId, std::vector<KeyframeId>> beside;
  for (const auto& [key, relation] : relations.relations()) {
    beside[key.first].push_back(key.second);
    beside[key.second].push_back(key.first);
  }
  std::vector<KeyframeId> tied;
  std::map<KeyframeId, bool> seen;
  std::vector<KeyframeId> open{origin};
  while (!open.empty()) {
    const KeyframeId id = open.back();
    open.pop_back();
    if (!keyframes.contains(id) || seen[id]) continue;
    seen[id] = true;
    tied.push_back(id);
    open.insert(open.end(), beside[id].begin(), beside[id].end());
  }
  std::sort(tied.begin(), tied.end());
  return tied;
}

std::optional<std::size_t> place_of(const KeyframeId& id, const std::vector<KeyframeId>& sorted) {
  const auto at = std::lower_bound(sorted.begin(), sorted.end(), id);
  if (at == sorted.end() || *at != id) return std::nullopt;
  return static_cast<std::size_t>(at - sorted.begin());
}

/// Rank of a relation in the spanning tree: odometry first, then other certain relations, then closures.
int rank_of(const RelationKey& key, const Relation& relation) {
  const auto& [a, b] = key;
  if (relation.robust) return 2;
  return are_successive(a, b) ? 0 : 1;
}

struct Graph {
  std::vector<Edge> edges;
  std::vector<int> ranks;
};

Graph graph_among(const std::vector<KeyframeId>& ids, const RelationSet& relations) {
  Graph graph;
  for (const auto& [key, relation] : relations.relations()) {
    const auto from = place_of(key.first, ids), to = place_of(key.second, ids);
    if (!from || !to) continue;
    graph.edges.push_back({*from, *to, relation.T_from_to, relation.information, relation.robust});
    graph.ranks.push_back(rank_of(key, relation));
  }
  return graph;
}

}  // namespace

Session canonical_session(const KeyframeSet& keyframes, const RelationSet& relations,
                          const KeyframeId& origin, const GraphParams& params) {
  Session out;
  const std::vector<KeyframeId> ids = tied_to(origin, keyframes, relations);
  if (ids.empty()) return out;
  for (const KeyframeId& id : ids) out.keyframes.push_back(keyframes.find(id));
  Graph graph = graph_among(ids, relations);
  out.poses = *spanning_start(ids.size(), graph.edges, graph.ranks);  // all nodes are connected
  out.edges = std::move(graph.edges);
  const std::size_t fixed = *place_of(origin, ids);
  const types::Se2 T_origin_first = out.poses[fixed].inverse();
  for (types::Se2& pose : out.poses) pose = T_origin_first * pose;
  out.poses[fixed] = {};
  // Walls are read at the poses of the first solution: along the tree, headings drift. What cannot be solved
  // keeps its poses.
  (void)solve_consistently(out.poses, with_odometry(out.keyframes, out.edges, params.odometry), params,
                           fixed);
  out.poses = solve_settled(out.keyframes, out.poses, out.edges, fixed, params).poses;
  return out;
}

CanonicalMap canonical_map(const KeyframeSet& keyframes, const RelationSet& relations,
                           const KeyframeId& origin, const GraphParams& graph, const GridParams& grid) {
  Session session = canonical_session(keyframes, relations, origin, graph);
  CanonicalMap out;
  out.map = std::make_unique<MapBuilder>(grid);
  if (session.keyframes.empty()) return out;
  for (const KeyframePtr& keyframe : session.keyframes) out.ids.push_back(keyframe->id);
  out.poses = std::move(session.poses);
  out.map->update(session.keyframes, out.poses);
  return out;
}

}  // namespace topo::slam
