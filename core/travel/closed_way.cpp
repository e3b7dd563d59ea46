// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/travel/closed_way.hpp"

#include <algorithm>
#include <cmath>

namespace topo::travel {

using types::Vector2;

std::optional<ClosedWay> closed_way(const grid::DenseMap& map, const grid::TravelField& field,
                                    std::span<const Vector2> way, double away_m) {
  const auto is_reached = [&](const Vector2& p) {
    const grid::CellIndex cell = map.cell_at(p);
    return map.contains(cell) && std::isfinite(field.cost_m[map.index(cell)]);
  };
  const auto first = std::ranges::find_if(way, is_reached);
  if (first == way.begin() || first == way.end()) return std::nullopt;
  const Vector2 closed_at = *std::prev(first);
  const auto from = std::find_if(
      first, way.end(), [&](const Vector2& p) { return is_reached(p) && (p - closed_at).norm() >= away_m; });
  return ClosedWay{from == way.end() ? *first : *from, closed_at};
}

std::vector<Vector2> positions_of(std::span<const types::KeyframePose> way, double gap_m) {
  std::vector<Vector2> positions;
  for (const types::KeyframePose& k : way) {
    const Vector2 p = k.T_map_base.se2().translation();
    if (!positions.empty() && (p - positions.back()).norm() > gap_m) positions.clear();
    positions.push_back(p);
  }
  return positions;
}

}  // namespace topo::travel
