// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/session.hpp"

#include <algorithm>
#include <cmath>

#include "core/slam/information.hpp"
#include "core/slam/make_keyframe.hpp"
#include "core/slam/mapper.hpp"

namespace topo::slam {
namespace {

constexpr double kMapReach_m = 1e5;    // the pose of an untrusted file must not make cell numbers overflow
constexpr double kNeighbour_m = 10.0;  // older keyframes this near support tracking on the new path

bool sane(const types::Se2& pose) {
  return std::abs(pose.x_m) <= kMapReach_m && std::abs(pose.y_m) <= kMapReach_m &&
         std::abs(pose.theta_rad) <= kMapReach_m;
}

}  // namespace

types::Status check_session(const Session& session) {
  const auto wrong = [](std::string text) {
    return types::fail(types::Errc::kInvalidInput, std::move(text));
  };
  const std::size_t n = session.keyframes.size();
  if (session.poses.size() != n)
    return wrong("found " + std::to_string(session.poses.size()) + " poses of " + std::to_string(n) +
                 " keyframes");
  for (std::size_t i = 0; i < n; ++i) {
    if (session.keyframes[i] == nullptr) return wrong("keyframe " + std::to_string(i) + " is missing");
    if (!sane(session.poses[i]))
      return wrong("the pose of keyframe " + std::to_string(i) + " is out of range");
  }
  for (std::size_t i = 0; i < session.edges.size(); ++i) {
    const Edge& edge = session.edges[i];
    if (edge.from >= n || edge.to >= n || edge.from == edge.to || !sane(edge.T_from_to) ||
        !edge.information.allFinite()) {
      return wrong("edge " + std::to_string(i) + " joins no two keyframes, or is out of range");
    }
  }
  return {};
}

void Mapper::resume(const Session& session, const Arrival& arrival) {
  // Keyframe numbers continue: no key of the grow-only set occurs twice.
  for (std::size_t i = 0; i < session.keyframes.size(); ++i) {
    const KeyframeId& id = session.keyframes[i]->id;
    if (id.origin() == maker_) next_sequence_ = std::max(next_sequence_, id.sequence + 1);
    if (id.robot == maker_.robot)
      add_own_node(session.keyframes[i], session.poses[i]);
    else
      add_mates_node(session.keyframes[i], session.poses[i]);
  }
  for (const Edge& edge : session.edges) add_found_edge(edge);  // sent again under this run
  edges_asked_ = edges_solved_ = edges_.size();
  relink();
  T_map_base_ = arrival.T_map_base;
  T_odom_base_ = arrival.T_odom_base;
  stamp_ = arrival.cloud.stamp;
  const std::size_t node = keyframes_.size();
  Edge edge;  // from the nearest keyframe
  for (std::size_t i = 0; i < node; ++i) {
    const double d = distance_m(poses_[i], T_map_base_);
    if (d < distance_m(poses_[edge.from], T_map_base_)) edge.from = i;
    if (d < kNeighbour_m) neighbours_.push_back(i);
  }
  edge.to = node;
  edge.T_from_to = poses_[edge.from].inverse() * T_map_base_;
  edge.information = edge_information(arrival.information, T_map_base_.theta_rad,
                                      params_.graph.loop_trans_floor_m, params_.graph.loop_rot_floor_rad);
  select_points(arrival.cloud, params_.cloud, points_);
  add_own_node(make_keyframe({maker_.robot, next_sequence_++, maker_.run}, arrival.cloud, points_,
                             T_odom_base_, {}, params_.cloud),
               T_map_base_);
  add_found_edge(edge);
  resumed_at_ = own_.size() - 1;
  rebuild_local_map();
}

}  // namespace topo::slam
