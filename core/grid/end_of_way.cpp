// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/grid/end_of_way.hpp"

#include <cmath>
#include <vector>

#include "core/grid/disc_room.hpp"

namespace topo::grid {

std::optional<CellIndex> end_of_way(const DenseMap& map, std::span<const float> clearance_m,
                                    const TravelField& field, CellIndex goal, double radius_m,
                                    double within_m) {
  const auto reach = static_cast<std::int32_t>(within_m / map.resolution_m);
  DiscRoom room(map, {{goal.x - reach, goal.y - reach}, {goal.x + reach, goal.y + reach}}, radius_m);
  struct Step {
    CellIndex cell;
    bool past_unknown;  // the chain passes so near to unknown cells that the robot may not fit through
  };
  std::vector<Step> queue;
  const auto enter = [&](CellIndex cell, bool past_unknown) {
    if (!room.is_open(cell) || map.state(cell) != CellState::kFree) return;
    room.close(cell);
    const bool has_room = static_cast<double>(clearance_m[map.index(cell)]) >= radius_m;
    queue.push_back({cell, past_unknown || !has_room});
  };
  enter(goal, false);
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const auto [cell, past_unknown] = queue[i];
    if (field.can_stay_at(map.index(cell)))
      return past_unknown || i == 0 ? std::optional(cell) : std::nullopt;
    enter({cell.x + 1, cell.y}, past_unknown);
    enter({cell.x - 1, cell.y}, past_unknown);
    enter({cell.x, cell.y + 1}, past_unknown);
    enter({cell.x, cell.y - 1}, past_unknown);
  }
  return std::nullopt;
}

}  // namespace topo::grid
