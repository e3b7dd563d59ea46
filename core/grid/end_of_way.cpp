// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/grid/end_of_way.hpp"

#include <cmath>
#include <vector>

#include "core/grid/disc_room.hpp"

namespace topo::grid {

std::optional<CellIndex> end_of_way(const DenseMap& map, const TravelField& field, CellIndex goal,
                                    double radius_m, double within_m) {
  const auto reach = static_cast<std::int32_t>(within_m / map.resolution_m);
  DiscRoom room(map, {{goal.x - reach, goal.y - reach}, {goal.x + reach, goal.y + reach}}, radius_m);
  std::vector<CellIndex> queue;
  const auto enter = [&](CellIndex cell) {
    if (!room.is_open(cell) || map.state(cell) != CellState::kFree) return;
    room.close(cell);
    queue.push_back(cell);
  };
  enter(goal);
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const CellIndex cell = queue[i];
    if (!std::isinf(field.cost_m[map.index(cell)])) return cell;
    enter({cell.x + 1, cell.y});
    enter({cell.x - 1, cell.y});
    enter({cell.x, cell.y + 1});
    enter({cell.x, cell.y - 1});
  }
  return std::nullopt;
}

}  // namespace topo::grid
