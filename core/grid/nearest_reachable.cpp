// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/grid/nearest_reachable.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace topo::grid {
namespace {

/// Calls f for the cells of the square ring `distance` cells around c.
template <class F>
void for_ring(CellIndex c, int distance, F&& f) {
  if (distance == 0) return f(c);
  for (int i = -distance; i < distance; ++i) {
    f(CellIndex{c.x + i, c.y - distance});
    f(CellIndex{c.x + distance, c.y + i});
    f(CellIndex{c.x - i, c.y + distance});
    f(CellIndex{c.x - distance, c.y - i});
  }
}

/// Distance of a cell from the box, along x or y; a double, because 32 bits may overflow.
double cells_outside(const CellBox& box, CellIndex c) {
  const auto outside = [](double v, double low, double high) { return std::max({0.0, low - v, v - high}); };
  return std::max(outside(c.x, box.min.x, box.max.x), outside(c.y, box.min.y, box.max.y));
}

/// Nearest cell for which is_meant(index) is true; ties go to the lowest travel cost.
template <class IsMeant>
std::optional<CellIndex> nearest_of(const DenseMap& map, const TravelField& field, CellIndex goal,
                                    double within_m, IsMeant is_meant) {
  std::optional<CellIndex> best;
  if (map.box.empty() || cells_outside(map.box, goal) * map.resolution_m > within_m) return best;
  double best_m = within_m;
  float best_cost_m = std::numeric_limits<float>::infinity();
  const int side = std::max({std::abs(goal.x - map.box.min.x), std::abs(goal.x - map.box.max.x),
                             std::abs(goal.y - map.box.min.y), std::abs(goal.y - map.box.max.y)});
  for (int ring = 0; ring <= side && ring * map.resolution_m <= best_m; ++ring) {
    for_ring(goal, ring, [&](CellIndex cell) {
      if (!map.contains(cell) || !is_meant(map.index(cell))) return;
      const float cost_m = field.cost_m[map.index(cell)];
      const double away_m = std::hypot(cell.x - goal.x, cell.y - goal.y) * map.resolution_m;
      if (away_m > best_m || (away_m == best_m && cost_m >= best_cost_m)) return;
      best = cell;
      best_m = away_m;
      best_cost_m = cost_m;
    });
  }
  return best;
}

}  // namespace

std::optional<CellIndex> nearest_reachable(const DenseMap& map, const TravelField& field, CellIndex goal,
                                           double within_m) {
  return nearest_of(map, field, goal, within_m, [&](std::size_t i) { return !std::isinf(field.cost_m[i]); });
}

std::optional<CellIndex> nearest_to_stay_at(const DenseMap& map, const TravelField& field, CellIndex goal,
                                            double within_m) {
  return nearest_of(map, field, goal, within_m, [&](std::size_t i) { return field.can_stay_at(i); });
}

}  // namespace topo::grid
