// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/types/se2.hpp"
#include "core/types/wheel_calibration.hpp"
#include "core/walls/coronal_mount.hpp"
#include "tests/sim/difficulty.hpp"

namespace topo::bench {

inline constexpr double kLevelHeight_m = 0.30;

/// What a robot is, whatever its owner wrote down (TapeMeasured): front scanner turned by 7 degrees and 4
/// cm off its place, coronal one rolled by 3 degrees, status packets 60 ms late.
struct TrueRobot {
  types::Se2 T_base_laser{0.128, 0.028, 7.0 * types::kDegree_rad};
  double delay_s = 0.060;  ///< of status packets, against what they are stamped with
  walls::CoronalMount coronal = mounted(0.02, -0.03, 0.47, 3.0 * types::kDegree_rad);

  static walls::CoronalMount mounted(double x_m, double y_m, double z_m, double roll_rad) {
    walls::CoronalMount mount;
    mount.x_m = x_m;
    mount.y_m = y_m;
    mount.z_m = z_m;
    mount.roll_rad = roll_rad;
    return mount;
  }
};

/// The places of its scanners as a tape measure says.
struct TapeMeasured {
  types::Se2 T_base_laser{0.10, 0.0, 0.0};
  walls::CoronalMount coronal = TrueRobot::mounted(0.0, 0.0, 0.45, 0.0);
};

/// Its wheels: 4 % off in travel, 8 % in their track, with signs that the seed draws; all else as ever.
inline sim::Difficulty difficulty_of_its_wheels() {
  sim::Difficulty difficulty;
  difficulty.wheel_scale_error = 0.04;
  difficulty.track_error = 0.08;
  return difficulty;
}

}  // namespace topo::bench
