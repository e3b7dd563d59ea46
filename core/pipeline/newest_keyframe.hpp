// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "core/pipeline/map_snapshot.hpp"

namespace topo::pipeline {

/// The newest keyframe of a map, to be found again in a later one: odometry that drifts moves the robot on
/// the map, and no keyframe.
struct NewestKeyframe {
  NewestKeyframe() = default;
  explicit NewestKeyframe(const MapSnapshot& map)
      : keyframe(map.keyframes.back()), number(map.keyframes.size() - 1) {}
  /// True when the map was bent there by more than that; so it is where the keyframe is missing.
  [[nodiscard]] bool is_bent(const MapSnapshot& now, double by_m, double by_rad) const;

  types::KeyframePose keyframe;
  std::size_t number = 0;  ///< among the map's
};

/// Where robots were, each by itself: corrected poses of its keyframes, in map.
std::vector<std::vector<types::Vector2>> driven_paths(const MapSnapshot& snapshot);

}  // namespace topo::pipeline
