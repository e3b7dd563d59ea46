// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

#include "tests/sim/shapes.hpp"

namespace topo::sim {

/// Position and direction of one sonar transducer on the base.
struct SonarMount {
  double x_m, y_m, heading_rad;
};

/// Dimensions of a Pioneer's body (PROTOCOLS sections 6.2 and 6.3).
struct RobotModel {
  std::string subclass;  ///< "p3dx-sh" or "p3at-sh"
  double track_m;        ///< effective, 2 / DiffConvFactor: used by the firmware
  double length_front_m, length_rear_m, width_m;
  double swing_radius_m;  ///< limit at which the corners are cut
  double height_m;        ///< body with the scanners' mast: lower hanging objects are obstacles
  double clearance_m;     ///< the robot drives over lower objects
  double sonar_z_m;
  int bumper_segments;  ///< front, and the same number at the rear
  std::array<SonarMount, 16> sonars;

  static RobotModel p3dx();
  static RobotModel p3at();
  /// Convex outline in the base frame, counter-clockwise.
  [[nodiscard]] Polygon footprint() const;
};

}  // namespace topo::sim
