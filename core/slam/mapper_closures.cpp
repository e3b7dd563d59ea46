// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

// The mapper's half that asks for closures and takes them in; tracking and keyframes are in mapper.cpp.

#include <cmath>
#include <utility>

#include "core/slam/loop_candidates.hpp"
#include "core/slam/mapper.hpp"

namespace topo::slam {
namespace {

constexpr int kClosuresBeforeSolve = 10;  ///< closures that agree with the graph wait for company
constexpr double kTensionChi2 = 1.0;      ///< a closure further off than this is solved for at once

}  // namespace

void Mapper::ask(std::size_t node) {
  const std::vector<LoopRun> runs = find_loop_runs(poses_, edges_, node, params_.loop);
  if (runs.empty()) return;
  LoopQuery query;
  query.node = node;
  query.keyframe = keyframes_[node];
  query.pose = poses_[node];
  query.params = params_;
  for (const LoopRun& run : runs) {
    LoopGroup group;
    group.reference = run.nearest;
    group.reference_pose = poses_[run.nearest];
    group.window = run.window;
    for (std::size_t i = run.first; i <= run.last; ++i) {
      group.keyframes.push_back(keyframes_[i]);
      group.poses.push_back(poses_[i]);
    }
    query.groups.push_back(std::move(group));
  }
  query_ = std::move(query);
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
    const Eigen::Vector3d e =
        edge_error(candidate.edge, poses_[candidate.edge.from], poses_[candidate.edge.to]);
    tension = tension || e.dot(candidate.edge.information * e) > kTensionChi2;
    edges_.push_back(candidate.edge);
  }
  closures_since_solve_ += verdict.accepted;
  if (!tension && closures_since_solve_ < kClosuresBeforeSolve) return verdict;
  const types::Vector2 before = poses_.back().translation();
  verdict.solved = optimise().solved;
  verdict.moved_m = (poses_.back().translation() - before).norm();
  return verdict;
}

SolveReport Mapper::optimise() {
  closures_since_solve_ = 0;
  if (poses_.empty()) return {};
  const types::Se2 T_last_base = poses_.back().inverse() * T_map_base_;
  const SolveReport report = solve(poses_, edges_, params_.graph);
  T_map_base_ = poses_.back() * T_last_base;
  rebuild_local_map();
  return report;
}

}  // namespace topo::slam
