// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "core/types/geometry.hpp"
#include "core/types/scan.hpp"

namespace topo::mocks {

/// Walls in the plane and an instant scanner: truth for tests of the mapper's parts, without the simulator.
struct FlatWorld {
  std::vector<types::Segment> walls;

  void box(double x0, double y0, double x1, double y1) {
    walls.push_back({{x0, y0}, {x1, y0}});
    walls.push_back({{x1, y0}, {x1, y1}});
    walls.push_back({{x1, y1}, {x0, y1}});
    walls.push_back({{x0, y1}, {x0, y0}});
  }

  /// Distance along a ray to the nearest wall, or infinity.
  [[nodiscard]] double range(double x, double y, double angle) const {
    const double dx = std::cos(angle), dy = std::sin(angle);
    double best = HUGE_VAL;
    for (const types::Segment& wall : walls) {
      const types::Vector2 e = wall.b - wall.a;
      const double det = e.x() * dy - e.y() * dx;
      if (std::abs(det) < 1e-12) continue;
      const double ax = wall.a.x() - x, ay = wall.a.y() - y;
      const double t = (e.x() * ay - e.y() * ax) / det, u = (dx * ay - dy * ax) / det;
      if (t > 0.0 && u >= 0.0 && u <= 1.0) best = std::min(best, t);
    }
    return best;
  }
};

struct ScannerOptions {
  int beams = 541;
  double fov_rad = 1.5 * std::numbers::pi;
  double range_max_m = 30.0;
  double sigma_m = 0.0;
};

/// A scan taken at one instant from a laser pose in the world.
inline types::Scan take_scan(const FlatWorld& world, const types::Se2& laser, types::Stamp stamp,
                             const ScannerOptions& options, std::mt19937& random) {
  types::Scan scan;
  scan.first_beam = scan.arrival = stamp;
  scan.beams = static_cast<std::uint16_t>(options.beams);
  scan.geometry.angle_min_rad = static_cast<float>(-0.5 * options.fov_rad);
  scan.geometry.angle_increment_rad = static_cast<float>(options.fov_rad / (options.beams - 1));
  scan.geometry.range_min_m = 0.02F;
  scan.geometry.range_max_m = static_cast<float>(options.range_max_m);
  std::normal_distribution<double> noise(0.0, 1.0);
  for (std::size_t i = 0; i < scan.beams; ++i) {
    const double r =
        world.range(laser.x_m, laser.y_m, laser.theta_rad + static_cast<double>(scan.angle_rad(i)));
    scan.range_m[i] =
        r < options.range_max_m ? static_cast<float>(r + options.sigma_m * noise(random)) : types::kNoReturn;
  }
  return scan;
}

/// Two rooms of different shape joined by a door, with an alcove and a pillar: determined in every direction.
inline FlatWorld two_rooms() {
  FlatWorld world;
  world.box(0.0, 0.0, 12.0, 8.0);
  world.walls.push_back({{7.0, 0.0}, {7.0, 3.0}});
  world.walls.push_back({{7.0, 4.2}, {7.0, 8.0}});
  world.box(2.0, 5.0, 2.6, 5.6);
  world.box(9.5, 1.0, 10.5, 2.2);
  world.walls.push_back({{4.0, 8.0}, {4.0, 7.2}});
  return world;
}

/// Two rooms that are alike to the last corner, one beside the other, and a corridor along both.
inline FlatWorld twin_rooms() {
  FlatWorld world;
  world.box(0.0, 0.0, 16.0, 10.0);
  world.walls.push_back({{8.0, 3.0}, {8.0, 10.0}});
  for (const double x : {0.0, 8.0}) {
    world.walls.push_back({{x, 3.0}, {x + 3.0, 3.0}});
    world.walls.push_back({{x + 4.0, 3.0}, {x + 8.0, 3.0}});
    world.box(x + 5.0, 8.0, x + 6.5, 9.0);
  }
  return world;
}

/// A ring corridor round a block, with niches that tell the places apart.
inline FlatWorld ring_corridor() {
  FlatWorld world;
  world.box(0.0, 0.0, 24.0, 18.0);
  world.box(2.5, 2.5, 21.5, 15.5);
  for (const double x : {4.0, 9.0, 11.5, 19.0}) world.box(x, 0.0, x + 0.6, 0.4);
  for (const double y : {3.0, 8.5, 10.0}) world.box(23.5, y, 24.0, y + 0.7);
  for (const double x : {5.0, 13.0, 16.0}) world.box(x, 17.5, x + 0.8, 18.0);
  for (const double y : {5.0, 12.0}) world.box(0.0, y, 0.5, y + 0.5);
  return world;
}

}  // namespace topo::mocks
