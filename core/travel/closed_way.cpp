// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/travel/closed_way.hpp"

#include <algorithm>
#include <cmath>

namespace topo::travel {

using types::Vector2;

std::optional<ClosedWay> closed_way(const grid::DenseMap& map, const grid::TravelField& field,
                                    std::span<const types::KeyframePose> way, double away_m) {
  const auto position = [](const types::KeyframePose& k) -> Vector2 {
    return k.T_map_base.se2().translation();
  };
  const auto is_reached = [&](const types::KeyframePose& k) {
    const grid::CellIndex cell = map.cell_at(position(k));
    return map.contains(cell) && std::isfinite(field.cost_m[map.index(cell)]);
  };
  const auto first = std::ranges::find_if(way, is_reached);
  if (first == way.begin() || first == way.end()) return std::nullopt;
  const Vector2 closed_at = position(*std::prev(first));
  const auto from = std::find_if(first, way.end(), [&](const types::KeyframePose& k) {
    return is_reached(k) && (position(k) - closed_at).norm() >= away_m;
  });
  return ClosedWay{position(from == way.end() ? *first : *from), closed_at};
}

}  // namespace topo::travel
