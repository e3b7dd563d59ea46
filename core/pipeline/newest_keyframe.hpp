// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "core/pipeline/map_snapshot.hpp"

namespace topo::pipeline {

/// The newest keyframe of a map, for comparison with a later map: odometry drift moves the robot on the map,
/// but no keyframe.
struct NewestKeyframe {
  NewestKeyframe() = default;
  explicit NewestKeyframe(const MapSnapshot& map)
      : keyframe(map.keyframes.back()), number(map.keyframes.size() - 1) {}
  /// True when the map has moved the keyframe by more than this; also when the keyframe is missing.
  [[nodiscard]] bool is_bent(const MapSnapshot& now, double by_m, double by_rad) const;

  types::KeyframePose keyframe;
  std::size_t number = 0;  ///< index in the map
};

/// Paths of all robots, one each: corrected positions of their keyframes, in map.
std::vector<std::vector<types::Vector2>> driven_paths(const MapSnapshot& snapshot);

}  // namespace topo::pipeline
