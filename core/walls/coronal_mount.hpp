// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace topo::walls {

/// Mounting of the coronal laser (paper section II): its scan plane is the y-z plane of base_link. Beam angle
/// 0 points up; angles count counter-clockwise towards +y, seen from behind (looking forward).
struct CoronalMount {
  double x_m = 0.0;
  double y_m = 0.0;
  double z_m = 0.4;
  double roll_rad = 0.0;       ///< of beam angle 0 from straight up, towards +y
  bool mirrored = false;       ///< true: angles count towards -y
  double height_min_m = 0.15;  ///< below: ground, also with the robot's pitch
  double height_max_m = 2.3;   ///< above: ceiling
  double range_max_m = 10.0;
};

}  // namespace topo::walls
