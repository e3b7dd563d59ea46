// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/motion/params.hpp"
#include "core/perception/moving_obstacle.hpp"
#include "core/types/stamp.hpp"

namespace topo::motion {

/// Waiting for a moving obstacle that passes. Recovery is not needed meanwhile; but the obstacle may wait as
/// well, so patience ends. Right of way when two robots both stood and could both drive on: the one that has
/// the other on its right stands longer.
class Yielding {
 public:
  explicit Yielding(const YieldingParams& params = {}) : params_(params) {}
  /// Call once per period. `held_up`: a moving obstacle is in the way. `moving` is in base, nearest first.
  void update(types::Stamp now, bool held_up, std::span<const perception::MovingObstacle> moving);
  /// True while the robot waits for a moving obstacle and patience has not ended.
  [[nodiscard]] bool waits() const { return waits_; }
  /// True while the other one has right of way.
  [[nodiscard]] bool lets_go_first() const { return lets_go_first_; }

 private:
  YieldingParams params_;
  types::Stamp since_{}, last_{};  ///< first and last time held up; zero: never
  bool on_the_right_ = false;
  bool waits_ = false, lets_go_first_ = false;
};

}  // namespace topo::motion
