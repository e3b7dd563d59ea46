// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/perception/moving_obstacle.hpp"
#include "core/types/stamp.hpp"

namespace topo::motion {

/// How a robot waits for what moves past it. While that is so there is nothing to recover from; but who is
/// waited for may wait as well, so patience ends. And of two that both stood and would both go on at once,
/// that one stands longer that has the other on its right.
class Yielding {
 public:
  /// Once a period. `held_up`: something that moves is in the way; `moving` in base.
  void update(types::Stamp now, bool held_up, std::span<const perception::MovingObstacle> moving);
  /// Something that moves is what it waits for, and patience has not ended.
  [[nodiscard]] bool waits() const { return waits_; }
  /// It lets the other one go first.
  [[nodiscard]] bool lets_go_first() const { return lets_go_first_; }

 private:
  types::Stamp since_{}, last_{};  ///< held up; zero: never
  bool on_the_right_ = false;
  bool waits_ = false, lets_go_first_ = false;
};

}  // namespace topo::motion
