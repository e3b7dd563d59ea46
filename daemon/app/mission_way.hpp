// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/types/se2.hpp"

namespace topo::daemon {

/// The distance that the robot drove since its newest mission began, by the base's odometry.
class MissionWay {
 public:
  /// A jump is a reset of the base's odometry, not motion: at 10 Hz no robot moves half a metre per tick.
  static constexpr double kJump_m = 0.5;

  void begin() { distance_m_ = 0.0; }

  /// To be called every tick. `at_odom`: metres in odom; void unless `has_base`. Counts while `under_way`.
  void note(const types::Vector2& at_odom, bool has_base, bool under_way) {
    const double way_m = (at_odom - from_).norm();
    if (measuring_ && under_way && way_m < kJump_m) distance_m_ += way_m;
    from_ = at_odom;
    measuring_ = has_base;
  }

  [[nodiscard]] double distance_m() const { return distance_m_; }

 private:
  double distance_m_ = 0.0;
  types::Vector2 from_{0.0, 0.0};
  bool measuring_ = false;  ///< `from_` holds
};

}  // namespace topo::daemon
