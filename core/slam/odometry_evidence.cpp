// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/odometry_evidence.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/slam/information.hpp"
#include "core/types/stamp.hpp"

namespace topo::slam {
namespace {

double match_chi2(const Edge& match, const types::Se2& T_from_to) {
  const Eigen::Vector3d off = edge_error(match, {}, T_from_to);
  return off.dot(match.information * off);
}

}  // namespace

bool are_successive(const KeyframeId& a, const KeyframeId& b) {
  return a.origin() == b.origin() && std::max(a.sequence, b.sequence) - std::min(a.sequence, b.sequence) == 1;
}

std::optional<Edge> contradicting_odometry(const Edge& match, const Keyframe& from, const Keyframe& to,
                                           const OdometryEvidenceParams& params) {
  if (match.robust || !are_successive(from.id, to.id) || from.T_odom_base == to.T_odom_base)
    return std::nullopt;
  Edge odometry;
  odometry.from = match.from;
  odometry.to = match.to;
  odometry.robust = true;
  odometry.T_from_to = from.T_odom_base.inverse() * to.T_odom_base;
  if (!is_drivable(odometry.T_from_to, std::abs(types::to_seconds(to.stamp - from.stamp)), params.noise))
    return std::nullopt;
  odometry.information = motion_information(odometry.T_from_to, params.noise);
  const Eigen::Vector3d off = edge_error(odometry, {}, match.T_from_to);
  if (off.dot(odometry.information * off) <= params.doubted_chi2) return std::nullopt;
  return odometry;
}

Eigen::Matrix3d believed_covariance(const Edge& edge, std::span<const KeyframePtr> keyframes,
                                    const OdometryEvidenceParams& params) {
  Eigen::Matrix3d covariance = edge.information.inverse();
  const auto odometry = contradicting_odometry(edge, *keyframes[edge.from], *keyframes[edge.to], params);
  if (!odometry) return covariance;
  const Eigen::Vector3d off = edge_error(edge, {}, odometry->T_from_to);
  return covariance + off * off.transpose();
}

std::vector<Edge> with_odometry(std::span<const KeyframePtr> keyframes, std::span<const Edge> edges,
                                const OdometryEvidenceParams& params) {
  std::vector<Edge> all(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto odometry =
        contradicting_odometry(edges[i], *keyframes[edges[i].from], *keyframes[edges[i].to], params);
    if (!odometry) continue;
    all[i].doubt_chi2 = match_chi2(edges[i], odometry->T_from_to);
    all.push_back(*odometry);
  }
  return all;
}

}  // namespace topo::slam
