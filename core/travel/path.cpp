// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/travel/path.hpp"

#include <algorithm>
#include <cmath>

namespace topo::travel {
namespace {

using grid::CellIndex;
using grid::DenseMap;
using types::Vector2;

float clearance_at(const DenseMap& map, std::span<const float> clearance_m, const Vector2& p) {
  const CellIndex cell = map.cell_at(p);
  return map.contains(cell) ? clearance_m[map.index(cell)] : 0.0F;
}

/// Smallest clearance on a straight line, sampled every half cell.
float clearance_along(const DenseMap& map, std::span<const float> clearance_m, const Vector2& a,
                      const Vector2& b) {
  const int steps = std::max(1, static_cast<int>(std::ceil((b - a).norm() / (0.5 * map.resolution_m))));
  float least = HUGE_VALF;
  for (int i = 0; i <= steps; ++i)
    least = std::min(least, clearance_at(map, clearance_m, a + (b - a) * (static_cast<double>(i) / steps)));
  return least;
}

/// The farthest cell after `from` to which the straight line keeps the clearance of the route.
std::size_t shortcut(const DenseMap& map, std::span<const float> clearance_m,
                     std::span<const CellIndex> route, std::size_t from, float preferred_m,
                     const PathParams& params) {
  float needed = std::min(preferred_m, clearance_m[map.index(route[from])]);
  std::size_t best = from + 1;
  for (std::size_t to = from + 1; to < std::min(route.size(), from + params.shortcut_cells); ++to) {
    needed = std::min(needed, clearance_m[map.index(route[to])]);
    if (to % params.shortcut_stride != 0 && to + 1 != route.size()) continue;
    if (clearance_along(map, clearance_m, map.centre_of(route[from]), map.centre_of(route[to])) >= needed)
      best = to;
  }
  return best;
}

std::vector<Vector2> resampled(const std::vector<Vector2>& corners, double spacing_m) {
  std::vector<Vector2> points{corners.front()};
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Vector2 step = corners[i] - corners[i - 1];
    const int pieces = std::max(1, static_cast<int>(std::lround(step.norm() / spacing_m)));
    for (int k = 1; k <= pieces; ++k)
      points.push_back(corners[i - 1] + step * (static_cast<double>(k) / pieces));
  }
  return points;
}

/// Moves every point towards the middle of its neighbours when that keeps the needed clearance.
void round_corners(const DenseMap& map, std::span<const float> clearance_m, float preferred_m,
                   std::vector<Vector2>& points) {
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Vector2 middle = 0.25 * points[i - 1] + 0.5 * points[i] + 0.25 * points[i + 1];
    const float before = std::min(preferred_m, clearance_at(map, clearance_m, points[i]));
    if (clearance_at(map, clearance_m, middle) >= before) points[i] = middle;
  }
}

}  // namespace

std::vector<Vector2> smooth_path(const DenseMap& map, std::span<const float> clearance_m,
                                 std::span<const CellIndex> route, double preferred_m,
                                 const PathParams& params) {
  if (route.empty()) return {};
  const auto preferred = static_cast<float>(preferred_m);
  std::vector<Vector2> corners{map.centre_of(route.front())};
  for (std::size_t i = 0; i + 1 < route.size();) {
    i = shortcut(map, clearance_m, route, i, preferred, params);
    corners.push_back(map.centre_of(route[i]));
  }
  std::vector<Vector2> points = resampled(corners, params.spacing_m);
  for (int i = 0; i < params.roundings; ++i) round_corners(map, clearance_m, preferred, points);
  return points;
}

std::size_t nearest_point(std::span<const Vector2> path, const Vector2& here, const PathParams& params) {
  const auto end = path.begin() + static_cast<std::ptrdiff_t>(std::min(path.size(), params.near_points));
  const auto nearest = std::min_element(path.begin(), end, [&](const Vector2& a, const Vector2& b) {
    return (a - here).squaredNorm() < (b - here).squaredNorm();
  });
  return static_cast<std::size_t>(nearest - path.begin());
}

}  // namespace topo::travel
