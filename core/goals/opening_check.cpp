// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/opening_check.hpp"

#include <algorithm>
#include <cmath>

#include "core/grid/disc_room.hpp"

namespace topo::goals {
namespace {

using grid::CellIndex;
using grid::CellState;

/// The bounding box of an opening, extended by `reach` cells.
grid::CellBox surroundings_of(const grid::DenseMap& map, std::span<const std::uint32_t> opening, int reach) {
  grid::CellBox box;
  for (const std::uint32_t i : opening) box.extend(map.cell(i));
  return {{box.min.x - reach, box.min.y - reach}, {box.max.x + reach, box.max.y + reach}};
}

struct Step {
  CellIndex at, from;  ///< from: the opening's cell at which the route into the unknown began
};

}  // namespace

bool leads_to_unknown(const grid::DenseMap& map, std::span<const std::uint32_t> opening,
                      const GoalParams& params) {
  const int deep = static_cast<int>(std::lround(params.behind_m / map.resolution_m));
  const int reach = std::max(deep, static_cast<int>(std::lround(params.look_m / map.resolution_m)));
  const auto enough =
      static_cast<std::size_t>(std::ceil(params.behind_m2 / (map.resolution_m * map.resolution_m)));
  grid::DiscRoom room(map, surroundings_of(map, opening, reach), params.robot_radius_m);
  std::vector<Step> steps;
  bool goes_on = false;
  const auto visit_sides = [&](const Step& step) {
    for (const CellIndex by : grid::kSideSteps) {
      const CellIndex to{step.at.x + by.x, step.at.y + by.y};
      if (!room.is_open(to) || map.state(to) != CellState::kUnknown) continue;
      room.close(to);
      const double dx = to.x - step.from.x, dy = to.y - step.from.y;
      goes_on = goes_on || dx * dx + dy * dy >= static_cast<double>(deep) * deep;
      steps.push_back({to, step.from});
    }
  };
  for (const std::uint32_t i : opening) {
    const CellIndex c = map.cell(i);
    if (room.is_open(c)) visit_sides({c, c});
  }
  for (std::size_t next = 0; next < steps.size() && !(goes_on && steps.size() >= enough); ++next)
    visit_sides(Step(steps[next]));
  return goes_on && steps.size() >= enough;
}

}  // namespace topo::goals
