// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/continued_walls.hpp"

#include <algorithm>

namespace topo::goals {
namespace {

/// Distance from `end` along `direction` to the first free cell beyond the jamb, or length_m.
double unseen_m(const grid::DenseMap& map, const types::Vector2& end, const types::Vector2& direction,
                const ContinuedWallParams& params) {
  double reach_m = 0.0;
  for (int k = 1; reach_m < params.length_m; ++k) {
    const double next_m = std::min(k * map.resolution_m, params.length_m);
    const grid::CellIndex cell = map.cell_at(end + next_m * direction);
    if (map.state(cell) == grid::CellState::kFree && next_m > params.jamb_m) break;
    reach_m = next_m;
  }
  return reach_m;
}

}  // namespace

std::vector<types::Segment> continued_walls(const grid::DenseMap& map, std::span<const types::Segment> walls,
                                            const ContinuedWallParams& params) {
  std::vector<types::Segment> continued;
  continued.reserve(2 * walls.size());
  for (const types::Segment& wall : walls) {
    const double length_m = wall.length_m();
    if (length_m <= 0.0) continue;
    const types::Vector2 along = (wall.b - wall.a) / length_m;
    continued.push_back({wall.a, wall.a - unseen_m(map, wall.a, -along, params) * along});
    continued.push_back({wall.b, wall.b + unseen_m(map, wall.b, along, params) * along});
  }
  return continued;
}

}  // namespace topo::goals
