// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

// The part of the mapper that requests closures and applies them; tracking and keyframes are in mapper.cpp.

#include <algorithm>
#include <cmath>
#include <span>
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
  open_questions_.ask(node, poses_[node]);
  const std::size_t end = end_of_other_visits(poses_, own_, own_.size() - 1, params_.loop);
  if (end == 0 && mates_.empty()) return;
  const std::vector<double> distances_m = links_.distances_m(poses_.size(), node);
  LoopQuery query = query_about(node);
  for (const LoopRun& run : find_loop_runs(poses_, distances_m, node, own_, end, params_.loop))
    query.groups.push_back(group_of(run, own_));
  for (LoopGroup& group : groups_of_mates(node, distances_m)) query.groups.push_back(std::move(group));
  if (!query.groups.empty()) query_ = std::move(query);
}

/// One node per call: each costs as much as the request of a new keyframe.
std::optional<LoopQuery> Mapper::take_second_query() {
  const auto node = open_questions_.take();
  if (!node) return std::nullopt;
  open_questions_.ask(*node, poses_[*node]);
  const auto place =
      static_cast<std::size_t>(std::lower_bound(own_.begin(), own_.end(), *node) - own_.begin());
  const std::size_t end = end_of_other_visits(poses_, own_, place, params_.loop);
  const std::vector<double> distances_m = links_.distances_m(poses_.size(), *node);
  LoopQuery query = query_about(*node);
  for (const LoopRun& run : find_loop_runs(poses_, distances_m, *node, own_, end, params_.loop))
    query.groups.push_back(group_of(run, own_));
  if (query.groups.empty()) return std::nullopt;
  return query;
}

std::optional<LoopQuery> Mapper::take_query() { return std::exchange(query_, std::nullopt); }

LoopVerdict Mapper::apply(const LoopAnswer& answer) {
  LoopVerdict verdict;
  for (const LoopCandidate& candidate : answer.candidates) {
    if (candidate.rejection != LoopRejection::kNone) {
      ++verdict.rejected;
      continue;
    }
    ++verdict.accepted;
    open_questions_.close(answer.node);
    if (!is_known(candidate.edge)) add_found_edge(candidate.edge);
  }
  return verdict;
}

/// True when the position is as certain as from a match. Known starts are less certain: there the maps are
/// still to be matched.
bool Mapper::is_as_sure_as_a_match(const Edge& edge) const {
  const double sigma_m = 2.0 * params_.graph.loop_trans_floor_m;
  return edge.information.topLeftCorner<2, 2>().diagonal().minCoeff() * sigma_m * sigma_m > 1.0;
}

/// True when the error exceeds half the narrowest loop search window.
bool Mapper::is_far_off(const Edge& edge) const {
  const Eigen::Vector3d error = edge_error(edge, poses_[edge.from], poses_[edge.to]);
  return error.head<2>().norm() > 0.5 * params_.loop.search_floor_m ||
         std::abs(error.z()) > 0.5 * params_.loop.search_floor_rad;
}

bool Mapper::is_known(const Edge& edge) const {
  return known_.contains({keyframes_[edge.from]->id, keyframes_[edge.to]->id});
}

/// A path over an edge that the poses do not satisfy yet would understate their uncertainty.
void Mapper::add_edge(const Edge& edge) {
  if (is_far_off(edge))
    unlinked_.push_back(edges_.size());
  else
    links_.add(edge);
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

bool Mapper::has_something_new() const {
  int closures = 0;
  for (const Edge& edge : std::span(edges_).subspan(edges_asked_)) {
    closures += edge.robust ? 1 : 0;
    if (closures >= kClosuresBeforeSolve || is_tense(edge)) return true;
  }
  return false;
}

std::optional<GraphQuery> Mapper::take_graph_query() {
  if (solving_ || !has_something_new()) return std::nullopt;
  solving_ = true;
  edges_asked_ = edges_.size();
  return GraphQuery{poses_, edges_, params_.graph};
}

std::vector<types::Se2> Mapper::corrected(const GraphSolution& solution) const {
  return corrected_poses(solution.poses, poses_, std::span(edges_).subspan(edges_asked_));
}

void Mapper::adopt(std::vector<types::Se2> poses) {
  const types::Se2 T_last_base = poses_[own_.back()].inverse() * T_map_base_;
  poses_ = std::move(poses);
  T_map_base_ = poses_[own_.back()] * T_last_base;
  solving_ = false;
  edges_solved_ = edges_asked_;
  relink();
  open_questions_.correct(poses_);
  rebuild_local_map();
}

void Mapper::give_up_solving() {
  solving_ = false;
  edges_asked_ = edges_solved_;
}

SolveReport Mapper::optimise() {
  if (own_.empty()) return {};
  edges_asked_ = edges_.size();
  const GraphSolution solution = solve_graph({poses_, edges_, params_.graph});
  adopt(solution.poses);
  return solution.report;
}

/// Links the edges that the poses satisfy now. The others are too new, or closures that the rest contradicts.
void Mapper::relink() {
  std::erase_if(unlinked_, [&](std::size_t i) {
    if (is_far_off(edges_[i])) return false;
    links_.add(edges_[i]);
    return true;
  });
}

}  // namespace topo::slam
