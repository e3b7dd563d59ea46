// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/goal_ways.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/grid/nearest_reachable.hpp"

namespace topo::exploration {
namespace {

double cells_apart(const grid::CellIndex& a, const grid::CellIndex& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

}  // namespace

void GoalWays::search_from(std::size_t from, std::span<const std::size_t> to, const grid::DenseMap& map,
                           std::span<const float> clearance_m, const grid::TravelRules& rules) {
  constexpr double kFarther = 1.25;  // growth of the bound of a search that ends when all goals are settled
  double straight_m = params_.reach_m;
  for (const std::size_t goal : to)
    straight_m = std::max(straight_m, (map.centre_of(cells_[goal]) - map.centre_of(cells_[from])).norm());
  search_.begin(map, clearance_m, cells_[from], rules, field_);
  const auto is_found = [&](std::size_t goal) {
    return map.contains(cells_[goal]) &&
           static_cast<double>(field_.cost_m[map.index(cells_[goal])]) < search_.settled_m();
  };
  // Usually all goals are found before the whole map is searched.
  for (double bound_m = kFarther * straight_m;; bound_m *= kFarther) {
    search_.advance(bound_m);
    if (std::isinf(search_.settled_m()) || std::all_of(to.begin(), to.end(), is_found)) break;
  }
  const std::size_t n = cells_.size();
  for (const std::size_t goal : to) {
    const auto cell = grid::nearest_reachable(map, field_, cells_[goal], params_.reach_m);
    const double cost_m = cell ? static_cast<double>(field_.cost_m[map.index(*cell)]) : HUGE_VAL;
    cost_m_[from * n + goal] = cost_m_[goal * n + from] = cost_m;
  }
}

/// Takes over the known costs from the old cells to the same ones and, until these are searched themselves,
/// to cells beside an old one: a goal recedes as the robot approaches.
void GoalWays::take_over(std::span<const grid::CellIndex> cells, double cell_m) {
  const std::vector<grid::CellIndex> old_cells = std::exchange(cells_, {cells.begin(), cells.end()});
  const std::size_t n = cells_.size(), old_n = old_cells.size();
  const std::vector<double> old_m = std::exchange(cost_m_, std::vector<double>(n * n, HUGE_VAL));
  const std::vector<bool> was_searched = std::exchange(is_searched_, std::vector<bool>(n, false));
  std::vector<std::size_t> old;  // index of the old cell of each cell; `old_n`: none
  for (std::size_t i = 0; i < n; ++i) {
    const auto nearest = std::min_element(old_cells.begin(), old_cells.end(),
                                          [&](const grid::CellIndex& a, const grid::CellIndex& b) {
                                            return cells_apart(cells_[i], a) < cells_apart(cells_[i], b);
                                          });
    const bool is_near =
        nearest != old_cells.end() && cell_m * cells_apart(cells_[i], *nearest) <= params_.beside_m;
    old.push_back(is_near ? static_cast<std::size_t>(nearest - old_cells.begin()) : old_n);
    is_searched_[i] = is_near && *nearest == cells_[i] && was_searched[old[i]];
  }
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < n; ++b) {
      if (old[a] == old_n || old[b] == old_n) continue;
      cost_m_[a * n + b] =
          std::max(old_m[old[a] * old_n + old[b]], cell_m * cells_apart(cells_[a], cells_[b]));
    }
    cost_m_[a * n + a] = 0.0;
  }
}

/// Chooses one of the searched cells in turn, and of the others those farthest from all searched ones.
std::vector<std::size_t> GoalWays::to_search() {
  std::vector<std::size_t> chosen;
  const std::size_t n = cells_.size();
  if (n > 0 && is_searched_[++turn_ % n]) chosen.push_back(turn_ % n);
  while (chosen.size() < params_.searches) {
    std::size_t farthest = n;
    double farthest_cells = -1.0;
    for (std::size_t i = 0; i < n; ++i) {
      if (is_searched_[i]) continue;
      double away_cells = HUGE_VAL;
      for (std::size_t k = 0; k < n; ++k)
        if (is_searched_[k]) away_cells = std::min(away_cells, cells_apart(cells_[i], cells_[k]));
      if (away_cells <= farthest_cells) continue;
      farthest = i;
      farthest_cells = away_cells;
    }
    if (farthest == n) break;
    is_searched_[farthest] = true;
    chosen.push_back(farthest);
  }
  return chosen;
}

/// Estimates unknown costs by routes through a cell searched now.
void GoalWays::bridge(std::span<const std::size_t> searched) {
  const std::size_t n = cells_.size();
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < n; ++b) {
      if (!std::isinf(cost_m_[a * n + b])) continue;
      for (const std::size_t via : searched)
        cost_m_[a * n + b] = std::min(cost_m_[a * n + b], cost_m_[a * n + via] + cost_m_[via * n + b]);
    }
  }
}

void GoalWays::update(const grid::DenseMap& map, std::span<const float> clearance_m,
                      const grid::TravelRules& rules, std::span<const grid::CellIndex> cells) {
  take_over(cells, map.resolution_m);
  const std::vector<std::size_t> searched = to_search();
  for (auto from = searched.begin(); from != searched.end(); ++from) {
    std::vector<std::size_t> to;
    for (std::size_t other = 0; other < cells_.size(); ++other)
      if (std::find(searched.begin(), from + 1, other) == from + 1) to.push_back(other);
    if (!to.empty()) search_from(*from, to, map, clearance_m, rules);
  }
  bridge(searched);
}

}  // namespace topo::exploration
