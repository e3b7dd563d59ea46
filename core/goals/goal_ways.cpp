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

void GoalWays::search_from(std::size_t from, const grid::DenseMap& map, std::span<const float> clearance_m,
                           const grid::TravelRules& rules) {
  search_.begin(map, clearance_m, cells_[from], rules, field_);
  search_.settle(HUGE_VAL);
  const std::size_t n = cells_.size();
  for (std::size_t to = 0; to < n; ++to) {
    const auto cell = grid::nearest_reachable(map, field_, cells_[to], kReach_m);
    const double cost_m = cell ? static_cast<double>(field_.cost_m[map.index(*cell)]) : HUGE_VAL;
    cost_m_[from * n + to] = cost_m_[to * n + from] = to == from ? 0.0 : cost_m;
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
  for (std::size_t i = 0; i < n; ++i)
    if (is_new(i) || i == turn_ % n) search_from(i, map, clearance_m, rules);
}

}  // namespace topo::goals
