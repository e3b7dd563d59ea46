// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

#include "tests/sim/shapes.hpp"

namespace topo::sim {

/// Place and direction of one sonar transducer on the base.
struct SonarMount {
  double x_m, y_m, heading_rad;
};

/// What a Pioneer's body is (PROTOCOLS sections 6.2 and 6.3).
struct RobotModel {
  std::string subclass;  ///< "p3dx-sh" or "p3at-sh"
  double track_m;        ///< effective, 2 / DiffConvFactor: what the firmware computes with
  double length_front_m, length_rear_m, width_m;
  double swing_radius_m;  ///< corners are cut to it
  double height_m;        ///< body with the scanners' mast: what bumps into hanging things
  double clearance_m;     ///< lower things are driven over
  double sonar_z_m;
  int bumper_segments;  ///< front, and as many behind
  std::array<SonarMount, 16> sonars;

  static RobotModel p3dx();
  static RobotModel p3at();
  /// Convex outline in the base frame, counter-clockwise.
  [[nodiscard]] Polygon footprint() const;
};

}  // namespace topo::sim
