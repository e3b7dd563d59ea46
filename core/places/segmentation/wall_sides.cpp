// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/wall_sides.hpp"

#include <cmath>

namespace topo::places {
namespace {

using grid::DenseMap;
using types::Segment;
using Labels = std::span<const std::uint32_t>;

/// The first label from `p` in the given direction, within `reach_m`; 0 when there is none.
std::uint32_t label_beside(const DenseMap& map, Labels labels, const types::Vector2& p,
                           const types::Vector2& direction, double reach_m) {
  for (double d = 0.5 * map.resolution_m; d <= reach_m; d += map.resolution_m) {
    const grid::CellIndex cell = map.cell_at(p + d * direction);
    if (!map.contains(cell)) return 0;
    const std::uint32_t label = labels[map.index(cell)];
    if (label != 0) return label;
  }
  return 0;
}

/// Calls f(a, b) for every step of a wall with labels on both sides. Steps lie evenly about the middle of the
/// wall: turned round it has the very same points, also where they are on the border of two cells.
template <class F>
void for_each_step(const DenseMap& map, Labels labels, const Segment& wall, const WallSideParams& params,
                   F&& f) {
  const double length_m = wall.length_m();
  const types::Vector2 along = (wall.b - wall.a) / length_m, across(-along.y(), along.x());
  const types::Vector2 middle = 0.5 * (wall.a + wall.b);
  const double steps = std::ceil(length_m / params.step_m - 0.5);
  for (double i = 0.5 - 0.5 * steps; i < 0.5 * steps; ++i) {
    const types::Vector2 p = middle + i * params.step_m * along;
    const std::uint32_t a = label_beside(map, labels, p, across, params.reach_m);
    if (a == 0) continue;
    const std::uint32_t b = label_beside(map, labels, p, -across, params.reach_m);
    if (b != 0) f(a, b);
  }
}

bool has_length(const Segment& wall) {
  const double length_m = wall.length_m();
  return length_m > 0.0 && std::isfinite(length_m);
}

}  // namespace

float wall_length_m(std::uint32_t steps, double step_m) {
  float length_m = 0.0F;
  for (; steps > 0; --steps) length_m += static_cast<float>(step_m);
  return length_m;
}

std::vector<WallBetween> wall_sides(const DenseMap& map, Labels labels, std::span<const Segment> walls,
                                    const WallSideParams& params) {
  std::vector<WallBetween> all;
  for (const Segment& wall : walls) {
    if (!has_length(wall)) continue;
    const std::size_t first = all.size();
    for_each_step(map, labels, wall, params, [&](std::uint32_t a, std::uint32_t b) {
      if (all.size() == first || all.back().a != a || all.back().b != b) all.push_back({a, b, 0});
      ++all.back().steps;
    });
  }
  return all;
}

}  // namespace topo::places
