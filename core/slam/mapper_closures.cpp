// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

// The mapper's half that asks for closures and takes them in; tracking and keyframes are in mapper.cpp.

#include <utility>

#include "core/slam/mapper.hpp"

namespace topo::slam {
LoopGroup Mapper::group_of(const LoopRun& run, Way way) const {
  LoopGroup group;
  group.reference = way[run.nearest];
  group.reference_pose = poses_[group.reference];
  group.window = run.window;
  for (std::size_t i = run.first; i <= run.last; ++i) {
    group.keyframes.push_back(keyframes_[way[i]]);
    group.poses.push_back(poses_[way[i]]);
  }
  return group;
}

LoopQuery Mapper::query_about(std::size_t node) const {
  LoopQuery query;
  query.node = node;
  query.keyframe = keyframes_[node];
  query.pose = poses_[node];
  query.params = params_;
  return query;
}

void Mapper::ask(std::size_t node) {
  const std::size_t end = end_of_other_visits(poses_, own_, own_.size() - 1, params_.loop);
  if (end == 0 && mates_.empty()) return;
  const std::vector<double> distances_m = graph_distances(poses_.size(), edges_, node);
  LoopQuery query = query_about(node);
  for (const LoopRun& run : find_loop_runs(poses_, distances_m, node, own_, end, params_.loop))
    query.groups.push_back(group_of(run, own_));
  for (LoopGroup& group : groups_of_mates(node, distances_m)) query.groups.push_back(std::move(group));
  if (!query.groups.empty()) query_ = std::move(query);
}

std::optional<LoopQuery> Mapper::take_query() { return std::exchange(query_, std::nullopt); }

LoopVerdict Mapper::apply(const LoopAnswer& answer) {
  LoopVerdict verdict;
  bool tension = false;
  for (const LoopCandidate& candidate : answer.candidates) {
    if (candidate.rejection != LoopRejection::kNone) {
      ++verdict.rejected;
      continue;
    }
    ++verdict.accepted;
    tension = tension || edge_chi2(candidate.edge, poses_) > kTensionChi2;
    add_found_edge(candidate.edge);
  }
  closures_since_solve_ += verdict.accepted;
  if (!tension && closures_since_solve_ < kClosuresBeforeSolve) return verdict;
  const std::size_t last = own_.back();
  const types::Vector2 before = poses_[last].translation();
  verdict.solved = optimise().solved;
  verdict.moved_m = (poses_[last].translation() - before).norm();
  return verdict;
}

/// What people say of starts is not: there the maps are still to be matched.
bool Mapper::is_as_sure_as_a_match(const Edge& edge) const {
  const double sigma_m = 2.0 * params_.graph.loop_trans_floor_m;
  return edge.information.topLeftCorner<2, 2>().diagonal().minCoeff() * sigma_m * sigma_m > 1.0;
}

void Mapper::add_edge(const Edge& edge) {
  edges_.push_back(edge);
  known_.emplace(keyframes_[edge.from]->id, keyframes_[edge.to]->id);
  const bool from_own = is_own(edge.from), to_own = is_own(edge.to);
  if (from_own != to_own && is_as_sure_as_a_match(edge)) tied_.insert(from_own ? edge.to : edge.from);
}

void Mapper::add_found_edge(const Edge& edge) {
  add_edge(edge);
  found_.push_back({{maker_.robot, static_cast<std::uint32_t>(found_.size()), maker_.run},
                    {keyframes_[edge.from]->id, keyframes_[edge.to]->id},
                    {edge.T_from_to, edge.information, edge.robust}});
}

SolveReport Mapper::optimise() {
  closures_since_solve_ = 0;
  if (own_.empty()) return {};
  const types::Se2 T_last_base = poses_[own_.back()].inverse() * T_map_base_;
  const SolveReport report = solve(poses_, edges_, params_.graph);
  T_map_base_ = poses_[own_.back()] * T_last_base;
  rebuild_local_map();
  return report;
}

}  // namespace topo::slam
