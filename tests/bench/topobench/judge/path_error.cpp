// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/judge/path_error.hpp"

#include <algorithm>
#include <cmath>

#include "tests/bench/topobench/judge/pose_file.hpp"

namespace topo::bench {

std::vector<PosePair> pair_up(std::span<const TimedPose> estimate, std::span<const TimedPose> truth) {
  std::vector<PosePair> pairs;
  for (const TimedPose& pose : estimate) {
    if (const auto true_pose = pose_at(truth, pose.stamp_s)) pairs.push_back({pose.pose, *true_pose});
  }
  return pairs;
}

PathError path_error(std::span<const PosePair> pairs, const types::Se2& T_building_map) {
  if (pairs.empty()) return {};
  PathError error;
  double sum = 0.0;
  for (const PosePair& pair : pairs) {
    const types::Vector2 believed = T_building_map * pair.T_map_base.translation();
    const double d = (believed - pair.T_building_base.translation()).norm();
    sum += d * d;
    error.worst_m = std::max(error.worst_m, d);
  }
  error.rmse_m = std::sqrt(sum / static_cast<double>(pairs.size()));
  return error;
}

types::Se2 best_fit(std::span<const PosePair> pairs) {
  if (pairs.empty()) return {};
  const double n = static_cast<double>(pairs.size());
  types::Vector2 a(0.0, 0.0), b(0.0, 0.0);
  for (const PosePair& pair : pairs) {
    a += pair.T_map_base.translation() / n;
    b += pair.T_building_base.translation() / n;
  }
  double cross = 0.0, dot = 0.0;
  for (const PosePair& pair : pairs) {
    const types::Vector2 p = pair.T_map_base.translation() - a, q = pair.T_building_base.translation() - b;
    cross += p.x() * q.y() - p.y() * q.x();
    dot += p.dot(q);
  }
  types::Se2 turn{0.0, 0.0, std::atan2(cross, dot)};
  const types::Vector2 offset = b - turn * a;
  return {offset.x(), offset.y(), turn.theta_rad};
}

}  // namespace topo::bench
