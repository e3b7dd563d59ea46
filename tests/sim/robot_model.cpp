// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/robot_model.hpp"

#include <algorithm>
#include <cmath>

#include "core/types/se2.hpp"

namespace topo::sim {

namespace {

struct SonarPlace {
  int x_mm, y_mm, degrees;
};

std::array<SonarMount, 16> in_metres(const std::array<SonarPlace, 16>& places) {
  std::array<SonarMount, 16> mounts{};
  std::transform(places.begin(), places.end(), mounts.begin(), [](const SonarPlace& p) {
    return SonarMount{p.x_mm * 1e-3, p.y_mm * 1e-3, p.degrees * types::kDegree_rad};
  });
  return mounts;
}

}  // namespace

RobotModel RobotModel::p3dx() {
  // Catalogue 455 x 381 mm; 210 mm in front of the axle. The scanners are on the mast.
  RobotModel m{"p3dx-sh", 2e-3 / 0.0056, 0.210, 0.245, 0.381, 0.267, 0.50, 0.03, 0.17, 5, {}};
  m.sonars = in_metres({{{69, 136, 90},
                         {114, 119, 50},
                         {148, 78, 30},
                         {166, 27, 10},
                         {166, -27, -10},
                         {148, -78, -30},
                         {114, -119, -50},
                         {69, -136, -90},
                         {-157, -136, -90},
                         {-203, -119, -130},
                         {-237, -78, -150},
                         {-255, -27, -170},
                         {-255, 27, 170},
                         {-237, 78, 150},
                         {-203, 119, 130},
                         {-157, 136, 90}}});
  return m;
}

RobotModel RobotModel::p3at() {
  RobotModel m{"p3at-sh", 2e-3 / 0.0034, 0.254, 0.254, 0.497, 0.340, 0.55, 0.05, 0.20, 5, {}};
  m.sonars = in_metres({{{147, 136, 90},
                         {193, 119, 50},
                         {227, 79, 30},
                         {245, 27, 10},
                         {245, -27, -10},
                         {227, -79, -30},
                         {193, -119, -50},
                         {147, -136, -90},
                         {-144, -136, -90},
                         {-189, -119, -130},
                         {-223, -79, -150},
                         {-241, -27, -170},
                         {-241, 27, 170},
                         {-223, 79, 150},
                         {-189, 119, 130},
                         {-144, 136, 90}}});
  return m;
}

Polygon RobotModel::footprint() const {
  // The rectangle with its corners cut where they exceed the swing circle.
  const double w = 0.5 * width_m;
  const auto side_x = [&](double length) {
    return std::min(length, std::sqrt(std::max(0.0, swing_radius_m * swing_radius_m - w * w)));
  };
  const auto end_y = [&](double length) {
    return std::min(w, std::sqrt(std::max(0.0, swing_radius_m * swing_radius_m - length * length)));
  };
  const double fx = side_x(length_front_m), fy = end_y(length_front_m);
  const double rx = side_x(length_rear_m), ry = end_y(length_rear_m);
  return {{length_front_m, -fy}, {length_front_m, fy},  {fx, w},   {-rx, w},
          {-length_rear_m, ry},  {-length_rear_m, -ry}, {-rx, -w}, {fx, -w}};
}

}  // namespace topo::sim
