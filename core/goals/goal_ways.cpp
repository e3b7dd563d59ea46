// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/goal_ways.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace topo::goals {
namespace {

constexpr double kReach_m = 0.6;  // to the nearest cell that a way leads to: goals stand near walls

}  // namespace

void GoalWays::search_from(std::size_t from, std::span<const std::size_t> to, const grid::DenseMap& map,
                           std::span<const float> clearance_m, const grid::TravelRules& rules) {
  constexpr double kDetour = 1.5;
  double straight_m = kReach_m;
  for (const std::size_t goal : to)
    straight_m = std::max(straight_m, (map.centre_of(cells_[goal]) - map.centre_of(cells_[from])).norm());
  search_.begin(map, clearance_m, cells_[from], rules, field_);
  const auto is_found = [&](std::size_t goal) {
    return map.contains(cells_[goal]) &&
           static_cast<double>(field_.cost_m[map.index(cells_[goal])]) < search_.settled_m();
  };
  // Mostly all are found before all of the map is.
  for (double bound_m = kDetour * straight_m;; bound_m *= 2.0) {
    search_.advance(bound_m);
    if (std::isinf(search_.settled_m()) || std::all_of(to.begin(), to.end(), is_found)) break;
  }
  const std::size_t n = cells_.size();
  for (const std::size_t goal : to) {
    const auto cell = grid::nearest_reachable(map, field_, cells_[goal], kReach_m);
    const double cost_m = cell ? static_cast<double>(field_.cost_m[map.index(*cell)]) : HUGE_VAL;
    cost_m_[from * n + goal] = cost_m_[goal * n + from] = cost_m;
  }
}

void GoalWays::update(const grid::DenseMap& map, std::span<const float> clearance_m,
                      const grid::TravelRules& rules, std::span<const grid::CellIndex> cells) {
  const std::vector<grid::CellIndex> old_cells = std::exchange(cells_, {cells.begin(), cells.end()});
  const std::vector<double> old_m = std::exchange(cost_m_, std::vector<double>(cells.size() * cells.size()));
  std::vector<std::size_t> was;  // index among the old cells; as many as they are: new
  for (const grid::CellIndex& cell : cells_)
    was.push_back(
        static_cast<std::size_t>(std::find(old_cells.begin(), old_cells.end(), cell) - old_cells.begin()));
  const auto is_new = [&](std::size_t i) { return was[i] == old_cells.size(); };
  const std::size_t n = cells_.size();
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < n; ++b)
      if (!is_new(a) && !is_new(b)) cost_m_[a * n + b] = old_m[was[a] * old_cells.size() + was[b]];
  }
  ++turn_;
  const auto is_searched = [&](std::size_t i) { return is_new(i) || i == turn_ % n; };
  std::vector<std::size_t> to;
  for (std::size_t i = 0; i < n; ++i) {
    if (!is_searched(i)) continue;
    to.clear();
    // A way between two that are searched is the second's.
    for (std::size_t other = 0; other < n; ++other)
      if (other < i || (other > i && !is_searched(other))) to.push_back(other);
    if (!to.empty()) search_from(i, to, map, clearance_m, rules);
  }
}

}  // namespace topo::goals
