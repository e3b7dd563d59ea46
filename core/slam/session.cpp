// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/session.hpp"

#include <cmath>

namespace topo::slam {
namespace {

constexpr double kMapReach_m = 1e5;

}  // namespace

bool is_in_reach(const types::Se2& pose) {
  return std::abs(pose.x_m) <= kMapReach_m && std::abs(pose.y_m) <= kMapReach_m &&
         std::abs(pose.theta_rad) <= kMapReach_m;
}

std::vector<std::size_t> way_of(std::span<const KeyframePtr> keyframes, std::uint16_t robot) {
  std::vector<std::size_t> way;
  for (std::size_t i = 0; i < keyframes.size(); ++i)
    if (keyframes[i]->id.robot == robot) way.push_back(i);
  return way;
}

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
    if (!is_in_reach(session.poses[i]))
      return wrong("the pose of keyframe " + std::to_string(i) + " is out of range");
  }
  for (std::size_t i = 0; i < session.edges.size(); ++i) {
    const Edge& edge = session.edges[i];
    if (edge.from >= n || edge.to >= n || edge.from == edge.to || !is_in_reach(edge.T_from_to) ||
        !edge.information.allFinite()) {
      return wrong("edge " + std::to_string(i) + " joins no two keyframes, or is out of range");
    }
  }
  return {};
}

}  // namespace topo::slam
