// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/map_graph.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "core/slam/odometry_evidence.hpp"
#include "core/types/invariant.hpp"

namespace topo::slam {

MapGraph::MapGraph(std::uint16_t robot, const LoopParams& loop, const GraphParams& graph)
    : robot_(robot),
      obeyed_m_(0.5 * loop.search_floor_m),
      obeyed_rad_(0.5 * loop.search_floor_rad),
      match_sigma_m_(graph.match_sigma_floors * graph.loop_trans_floor_m),
      tension_chi2_(graph.tension_chi2),
      loose_rad_(graph.loose_rad),
      drift_per_m_rad_(loop.drift_per_m_rad),
      odometry_(graph.odometry),
      tied_reach_(loop.tied_reach),
      links_(graph.turn_on_spot_m) {}

std::size_t MapGraph::add_node(KeyframePtr keyframe, const types::Se2& pose) {
  const std::size_t node = keyframes_.size();
  nodes_[keyframe->id] = node;
  keyframes_.push_back(std::move(keyframe));
  poses_.push_back(pose);
  return node;
}

std::size_t MapGraph::add_own(KeyframePtr keyframe, const types::Se2& pose) {
  types::require(keyframe->id.robot == robot_, "map graph: another robot's keyframe on the own path");
  own_.push_back(add_node(std::move(keyframe), pose));
  return own_.back();
}

std::size_t MapGraph::add_mates(KeyframePtr keyframe, const types::Se2& pose) {
  const KeyframeId id = keyframe->id;
  std::vector<std::size_t>& path = mates_[id.origin()];
  const auto at = std::upper_bound(path.begin(), path.end(), id,
                                   [&](const KeyframeId& a, std::size_t b) { return a < keyframes_[b]->id; });
  path.insert(at, keyframes_.size());
  return add_node(std::move(keyframe), pose);
}

void MapGraph::add(const Edge& edge) {
  const double loose = loose_m(edge);
  if (is_far_off(edge))
    unlinked_.push_back(edges_.size());
  else
    links_.add(edge, loose);
  if (loose > 0.0 && is_own(edge.to)) {
    // A session's keyframes come before its edges.
    const auto place =
        static_cast<std::size_t>(std::lower_bound(own_.begin(), own_.end(), edge.to) - own_.begin());
    loose_.insert(std::upper_bound(loose_.begin(), loose_.end(), place), place);
  }
  related_.emplace(key_of(edge), edges_.size());
  edges_.push_back(edge);
  const bool from_own = is_own(edge.from), to_own = is_own(edge.to);
  if (from_own != to_own && is_as_certain_as_a_match(edge)) tied_.insert(from_own ? edge.to : edge.from);
}

void MapGraph::keep_lower(const FoundRelation& found) {
  const Relation& relation = found.relation;
  const auto at = related_.find(found.key);
  if (at == related_.end()) return;
  Edge& edge = edges_[at->second];
  if (!is_lower(relation, {edge.T_from_to, edge.information, edge.robust})) return;
  edge.T_from_to = relation.T_from_to;
  edge.information = relation.information;
  edge.robust = relation.robust;
  edge.finder = found.id;
}

void MapGraph::move(std::vector<types::Se2> poses) {
  types::require(poses.size() == poses_.size(), "map graph: not a pose for every node");
  poses_ = std::move(poses);
  relink();
}

void MapGraph::relink() {
  std::erase_if(unlinked_, [&](std::size_t i) {
    if (is_far_off(edges_[i])) return false;
    links_.add(edges_[i], loose_m(edges_[i]));
    return true;
  });
}

std::optional<std::size_t> MapGraph::node_of(const KeyframeId& id) const {
  const auto at = nodes_.find(id);
  return at == nodes_.end() ? std::nullopt : std::optional(at->second);
}

bool MapGraph::is_own(std::size_t node) const { return std::binary_search(own_.begin(), own_.end(), node); }

bool MapGraph::is_tense(const Edge& edge) const { return edge_chi2(edge, poses_) > tension_chi2_; }

bool MapGraph::is_far_off(const Edge& edge) const {
  const Eigen::Vector3d error = edge_error(edge, poses_[edge.from], poses_[edge.to]);
  return error.head<2>().norm() > obeyed_m_ || std::abs(error.z()) > obeyed_rad_;
}

/// The way on which as much drift is to be expected as odometry's uncertainty over the edge's motion: where
/// nothing was matched, or where odometry contradicts the match.
double MapGraph::loose_m(const Edge& edge) const {
  if (edge.robust || !are_successive(keyframes_[edge.from]->id, keyframes_[edge.to]->id)) return 0.0;
  Eigen::Matrix3d covariance = edge.information.inverse();
  if (const auto odometry =
          contradicting_odometry(edge, *keyframes_[edge.from], *keyframes_[edge.to], odometry_))
    covariance += odometry->information.inverse();
  const double sigma_rad = std::sqrt(covariance(2, 2));
  return sigma_rad > loose_rad_ ? std::min(sigma_rad, std::numbers::pi) / drift_per_m_rad_ : 0.0;
}

std::size_t MapGraph::end_of_past(std::size_t place, std::span<const double> distances_m,
                                  const LoopParams& params) const {
  const std::size_t end = end_of_other_visits(poses_, own_, place, params);
  const auto newest = std::upper_bound(loose_.begin(), loose_.end(), place);
  const auto unspanned = std::find_if(std::make_reverse_iterator(newest), loose_.rend(), [&](std::size_t at) {
    return distances_m[own_[at - 1]] >= params.chain_gap_m;
  });
  return unspanned == loose_.rend() ? end : std::max(end, *unspanned);
}

/// A start pose that a person gave is less certain: those maps are still to be matched.
bool MapGraph::is_as_certain_as_a_match(const Edge& edge) const {
  const double information = edge.information.topLeftCorner<2, 2>().diagonal().minCoeff();
  return information * match_sigma_m_ * match_sigma_m_ > 1.0;
}

bool MapGraph::is_tied_to_own(std::size_t mates_node) const {
  const std::vector<std::size_t>& path = mates_.at(keyframes_[mates_node]->id.origin());
  const auto place = static_cast<std::size_t>(std::find(path.begin(), path.end(), mates_node) - path.begin());
  const std::size_t first = place > tied_reach_ ? place - tied_reach_ : 0;
  const std::size_t last = std::min(place + tied_reach_, path.size() - 1);
  for (std::size_t k = first; k <= last; ++k) {
    if (tied_.contains(path[k])) return true;
  }
  return false;
}

LoopGroup loop_group(const MapGraph& graph, const LoopRun& run, Way path) {
  LoopGroup group;
  group.reference = path[run.nearest];
  group.reference_pose = graph.poses()[group.reference];
  group.window = run.window;
  for (std::size_t i = run.first; i <= run.last; ++i) {
    group.keyframes.push_back(graph.keyframes()[path[i]]);
    group.poses.push_back(graph.poses()[path[i]]);
  }
  return group;
}

std::vector<LoopGroup> own_groups(const MapGraph& graph, std::size_t node, std::size_t end,
                                  std::span<const double> distances_m, const LoopParams& params) {
  std::vector<LoopGroup> groups;
  for (const LoopRun& run : find_loop_runs(graph.poses(), distances_m, node, graph.own(), end, params))
    groups.push_back(loop_group(graph, run, graph.own()));
  return groups;
}

std::vector<LoopGroup> mates_groups(const MapGraph& graph, std::size_t node,
                                    std::span<const double> distances_m, const LoopParams& params) {
  std::vector<std::pair<LoopRun, Way>> runs;
  for (const auto& [origin, path] : graph.mates()) {
    for (const LoopRun& run : find_loop_runs(graph.poses(), distances_m, node, path, path.size(), params))
      runs.emplace_back(run, path);
  }
  std::stable_sort(runs.begin(), runs.end(),
                   [](const auto& a, const auto& b) { return a.first.distance_m < b.first.distance_m; });
  std::vector<LoopGroup> groups;
  for (const auto& [run, path] : runs) {
    if (groups.size() == static_cast<std::size_t>(params.groups_max)) break;
    groups.push_back(loop_group(graph, run, path));
  }
  return groups;
}

}  // namespace topo::slam
