// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "core/types/se2.hpp"

namespace topo::walls {

using Points = std::vector<types::Vector2>;

/// Points every 2.5 cm along a straight line.
inline void draw_line(Points& points, const types::Vector2& a, const types::Vector2& b) {
  const double length_m = (b - a).norm();
  for (double at_m = 0.0; at_m <= length_m; at_m += 0.025) points.push_back(a + (b - a) * (at_m / length_m));
}

inline void draw_rectangle(Points& points, types::Vector2 min, types::Vector2 max) {
  draw_line(points, min, {max.x(), min.y()});
  draw_line(points, {max.x(), min.y()}, max);
  draw_line(points, max, {min.x(), max.y()});
  draw_line(points, {min.x(), max.y()}, min);
}

/// A corridor with rooms of different sizes at both sides, 32 m by 12 m.
inline Points building() {
  Points points;
  draw_rectangle(points, {0.0, 0.0}, {32.0, 12.0});
  draw_line(points, {0.0, 5.0}, {32.0, 5.0});
  draw_line(points, {0.0, 7.0}, {32.0, 7.0});
  for (const double x : {4.0, 9.5, 14.2, 21.0, 26.3}) draw_line(points, {x, 0.0}, {x, 5.0});
  for (const double x : {6.1, 12.7, 18.0, 25.5}) draw_line(points, {x, 7.0}, {x, 12.0});
  return points;
}

/// As much furniture as there is building: short slanted pieces and single points.
inline void furnish(Points& points, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> x(0.0, 32.0), y(0.0, 12.0), angle(0.0, 3.2), length(0.1, 0.8);
  const std::size_t enough = 2 * points.size();
  while (points.size() < enough) {
    const types::Vector2 p(x(random), y(random));
    const double turn = angle(random), reach = length(random);
    draw_line(points, p, p + reach * types::Vector2(std::cos(turn), std::sin(turn)));
    points.emplace_back(x(random), y(random));
  }
}

inline Points turned(const Points& points, double angle_rad) {
  const types::Se2 turn{3.0, -2.0, angle_rad};
  Points result;
  for (const types::Vector2& p : points) result.push_back(turn * p);
  return result;
}

/// Centres of the 5 cm cells that the points lie in, each once: what a grid makes of them.
inline Points cell_centres(const Points& points) {
  std::set<std::pair<int, int>> cells;
  for (const types::Vector2& p : points) {
    cells.emplace(static_cast<int>(std::floor(p.x() / 0.05)), static_cast<int>(std::floor(p.y() / 0.05)));
  }
  Points result;
  for (const auto& [x, y] : cells) result.emplace_back((x + 0.5) * 0.05, (y + 0.5) * 0.05);
  return result;
}

}  // namespace topo::walls
