// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/newest_keyframe.hpp"

namespace topo::pipeline {

bool NewestKeyframe::is_bent(const MapSnapshot& now, double by_m, double by_rad) const {
  if (number >= now.keyframes.size() || now.keyframes[number].stamp != keyframe.stamp) return true;
  return types::is_apart(keyframe.T_map_base.se2(), now.keyframes[number].T_map_base.se2(), by_m, by_rad);
}

std::vector<std::vector<types::Vector2>> driven_paths(const MapSnapshot& snapshot) {
  std::vector<std::vector<types::Vector2>> paths;
  const auto add = [&](const std::vector<types::KeyframePose>& poses) {
    std::vector<types::Vector2>& path = paths.emplace_back();
    path.reserve(poses.size());
    for (const types::KeyframePose& keyframe : poses) path.push_back(keyframe.T_map_base.se2().translation());
  };
  add(snapshot.keyframes);
  for (const std::vector<types::KeyframePose>& poses : snapshot.mates) add(poses);
  return paths;
}

}  // namespace topo::pipeline
