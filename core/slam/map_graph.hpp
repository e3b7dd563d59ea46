// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "core/slam/graph_links.hpp"
#include "core/slam/keyframe.hpp"
#include "core/slam/loop_candidates.hpp"
#include "core/slam/loop_closure.hpp"
#include "core/slam/pose_graph.hpp"
#include "core/slam/relation_set.hpp"
#include "core/slam/session.hpp"

namespace topo::slam {

/// The pose graph of the map: keyframes of this robot and of team-mates (nodes), their poses and the edges
/// between them. A node is a place in these lists. The shortest paths between nodes (distances_m) use only
/// edges that the poses obey: a new edge, or a closure that the other edges contradict, would make distances
/// look shorter than they are known to be.
class MapGraph {
 public:
  /// `robot`: whose keyframes form the own path, over all its runs.
  MapGraph(std::uint16_t robot, const LoopParams& loop, const GraphParams& graph);

  /// Appends a keyframe to the own path. Returns its node.
  std::size_t add_own(KeyframePtr keyframe, const types::Se2& pose);
  /// Inserts a keyframe into its origin's path, in the order of the keys. Returns its node.
  std::size_t add_mates(KeyframePtr keyframe, const types::Se2& pose);
  void add(const Edge& edge);
  /// Of two relations under one key all robots of a team keep the lower one, whichever came first. Nothing
  /// happens where the graph has no relation under the key. Poses follow with the next solution.
  void keep_lower(const FoundRelation& found);
  /// Replaces all poses; edges that these obey are links from now on.
  void move(std::vector<types::Se2> poses);

  [[nodiscard]] std::span<const KeyframePtr> keyframes() const { return keyframes_; }
  [[nodiscard]] std::span<const types::Se2> poses() const { return poses_; }
  [[nodiscard]] std::span<const Edge> edges() const { return edges_; }
  [[nodiscard]] Session session() const { return {keyframes_, poses_, edges_}; }

  /// Nodes of the own path, ascending.
  [[nodiscard]] std::span<const std::size_t> own() const { return own_; }
  /// Nodes of each other origin, in the order of the keys.
  [[nodiscard]] const std::map<Origin, std::vector<std::size_t>>& mates() const { return mates_; }
  [[nodiscard]] std::optional<std::size_t> node_of(const KeyframeId& id) const;
  [[nodiscard]] bool has(const RelationKey& key) const { return related_.contains(key); }
  [[nodiscard]] RelationKey key_of(const Edge& edge) const {
    return {keyframes_[edge.from]->id, keyframes_[edge.to]->id};
  }
  /// Metres of the shortest path over links from a node to every node; infinite where there is none.
  [[nodiscard]] std::vector<double> distances_m(std::size_t from) const {
    return links_.distances_m(poses_.size(), from);
  }
  /// Places of the own path before the returned one belong to other visits of what is seen from `place`: by
  /// the way (end_of_other_visits), or because a loose edge leads from there that no closure spans.
  /// `distances_m`: of the keyframe at `place`.
  [[nodiscard]] std::size_t end_of_past(std::size_t place, std::span<const double> distances_m,
                                        const LoopParams& params) const;
  /// True when the edge's squared error is above what may wait for the next solution of the graph.
  [[nodiscard]] bool is_tense(const Edge& edge) const;
  /// True when an edge as certain as a scan match leads from the own path to the team-mate's node, or to a
  /// near neighbour on its path: neighbours hardly drift apart.
  [[nodiscard]] bool is_tied_to_own(std::size_t mates_node) const;

 private:
  std::size_t add_node(KeyframePtr keyframe, const types::Se2& pose);
  void relink();
  [[nodiscard]] bool is_own(std::size_t node) const;
  [[nodiscard]] bool is_far_off(const Edge& edge) const;
  [[nodiscard]] bool is_as_certain_as_a_match(const Edge& edge) const;
  [[nodiscard]] double loose_m(const Edge& edge) const;

  std::uint16_t robot_;
  double obeyed_m_, obeyed_rad_;  ///< the narrowest search for closures covers twice as much
  double match_sigma_m_;          ///< a scan match is at least as certain
  double tension_chi2_;
  double loose_rad_, drift_per_m_rad_;
  OdometryEvidenceParams odometry_;
  std::size_t tied_reach_;
  std::vector<KeyframePtr> keyframes_;
  std::vector<types::Se2> poses_;  ///< of base_link, in map
  std::vector<Edge> edges_;
  std::map<KeyframeId, std::size_t> nodes_;
  std::vector<std::size_t> own_;
  std::vector<std::size_t> loose_;  ///< places of the own path to which a loose edge leads, ascending
  std::map<Origin, std::vector<std::size_t>> mates_;
  std::map<RelationKey, std::size_t> related_;  ///< edges by their ends
  GraphLinks links_;                            ///< edges that the poses obey
  std::vector<std::size_t> unlinked_;           ///< the other edges
  std::set<std::size_t> tied_;                  ///< nodes of team-mates with a certain edge to the own path
};

/// Part of a path as a group for the search for closures.
[[nodiscard]] LoopGroup loop_group(const MapGraph& graph, const LoopRun& run, Way path);

/// Groups of the own path's places before `end` that are near a node and far from it along the graph.
[[nodiscard]] std::vector<LoopGroup> own_groups(const MapGraph& graph, std::size_t node, std::size_t end,
                                                std::span<const double> distances_m,
                                                const LoopParams& params);

/// The same of team-mates' paths: the nearest groups, at most LoopParams::groups_max.
[[nodiscard]] std::vector<LoopGroup> mates_groups(const MapGraph& graph, std::size_t node,
                                                  std::span<const double> distances_m,
                                                  const LoopParams& params);

}  // namespace topo::slam
