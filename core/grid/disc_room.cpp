// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/grid/disc_room.hpp"

#include <algorithm>
#include <cmath>

namespace topo::grid {

DiscRoom::DiscRoom(const DenseMap& map, const CellBox& box, double radius_m)
    : box_(box), closed_(static_cast<std::size_t>(box.width() * box.height()), 0) {
  const double radius = radius_m / map.resolution_m;
  const auto reach = static_cast<std::int32_t>(std::ceil(radius));
  const std::int32_t y_from = std::max(box.min.y - reach, map.box.min.y);
  const std::int32_t y_to = std::min(box.max.y + reach, map.box.max.y);
  const std::int32_t x_from = std::max(box.min.x - reach, map.box.min.x);
  const std::int32_t x_to = std::min(box.max.x + reach, map.box.max.x);
  for (std::int32_t y = y_from; y <= y_to; ++y) {
    for (std::int32_t x = x_from; x <= x_to; ++x) {
      if (map.cells[map.index({x, y})] == CellState::kOccupied) close_disc({x, y}, radius);
    }
  }
}

void DiscRoom::close_disc(CellIndex centre, double radius) {
  const auto reach = static_cast<std::int32_t>(std::ceil(radius));
  for (std::int32_t v = -reach; v <= reach; ++v) {
    const double left = radius * radius - static_cast<double>(v) * v;
    if (left <= 0.0) continue;
    const auto half = static_cast<std::int32_t>(std::ceil(std::sqrt(left))) - 1;
    for (std::int32_t u = -half; u <= half; ++u) {
      const CellIndex c{centre.x + u, centre.y + v};
      if (contains(c)) close(c);
    }
  }
}

}  // namespace topo::grid
