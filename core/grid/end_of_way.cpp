// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/grid/end_of_way.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/grid/disc_room.hpp"

namespace topo::grid {

namespace {

CellBox box_around(CellIndex goal, const DenseMap& map, double within_m) {
  const double reach = within_m / map.resolution_m;
  const auto limited = [](double value, std::int32_t min, std::int32_t max) {
    return static_cast<std::int32_t>(std::clamp(value, static_cast<double>(min), static_cast<double>(max)));
  };
  const CellBox& all = map.box;
  const auto [x, y] = goal;
  return {{limited(std::ceil(x - reach), all.min.x, all.max.x),
           limited(std::ceil(y - reach), all.min.y, all.max.y)},
          {limited(std::floor(x + reach), all.min.x, all.max.x),
           limited(std::floor(y + reach), all.min.y, all.max.y)}};
}

}  // namespace

std::optional<CellIndex> end_of_way(const DenseMap& map, std::span<const float> clearance_m,
                                    const TravelField& field, CellIndex goal, double radius_m,
                                    const WayLimits& limits) {
  if (!map.contains(goal) || map.state(goal) != CellState::kFree) return std::nullopt;
  DiscRoom room(map, box_around(goal, map, limits.within_m), radius_m);
  struct Step {
    CellIndex cell;
    bool past_unknown;  // the chain passes so near to unknown cells that the robot may not fit through
  };
  // Cells with the same number of unknown ones on their chain, and those with one more.
  std::vector<Step> queue, later;
  const auto enter = [&](CellIndex cell, bool past_unknown) {
    if (!room.is_open(cell)) return;
    const bool is_known = map.state(cell) != CellState::kUnknown;
    const bool has_room = static_cast<double>(clearance_m[map.index(cell)]) >= radius_m;
    room.close(cell);
    (is_known ? queue : later).push_back({cell, past_unknown || !has_room});
  };
  enter(goal, false);
  for (double unseen_m = 0.0; !queue.empty() && unseen_m <= limits.unseen_m; unseen_m += map.resolution_m) {
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const auto [cell, past_unknown] = queue[i];
      if (field.can_stay_at(map.index(cell)))
        return past_unknown || cell == goal ? std::optional(cell) : std::nullopt;
      enter({cell.x + 1, cell.y}, past_unknown);
      enter({cell.x - 1, cell.y}, past_unknown);
      enter({cell.x, cell.y + 1}, past_unknown);
      enter({cell.x, cell.y - 1}, past_unknown);
    }
    queue = std::exchange(later, {});
  }
  return std::nullopt;
}

}  // namespace topo::grid
