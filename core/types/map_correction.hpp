// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/types/keyframe_pose.hpp"
#include "core/types/se2.hpp"

namespace topo::types {

/// What a correction of the map does to the places in it: each moves with the keyframe that was nearest to
/// it, from where it was seen.
class MapCorrection {
 public:
  /// From the map before the correction to the map now, around a point of the map before. O(keyframes).
  [[nodiscard]] const Se2& around(const Vector2& p_map) const;
  /// Where a point of the map before the correction is now.
  [[nodiscard]] Vector2 operator()(const Vector2& p_map) const { return around(p_map) * p_map; }
  /// Moves points in place.
  void move(std::span<Vector2> points) const {
    for (Vector2& p : points) p = (*this)(p);
  }

 private:
  friend class MapAnchors;
  struct Moved {
    Vector2 before;
    Se2 change;  ///< from the map before to the map now, at this keyframe
  };
  std::vector<Moved> keyframes_;  ///< at least one
};

/// The keyframe poses for which remembered places hold. A value.
class MapAnchors {
 public:
  /// Takes the robot's own keyframes of the newest map. Returns how remembered places move, when a keyframe
  /// has moved by more than `by_m` or `by_rad` since they last did; nothing when none has, or when these are
  /// other keyframes than before. O(keyframes).
  std::optional<MapCorrection> take(std::span<const KeyframePose> keyframes, double by_m, double by_rad);

 private:
  std::vector<KeyframePose> placed_;
};

}  // namespace topo::types
