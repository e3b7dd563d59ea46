// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/travel_table.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/grid/nearest_reachable.hpp"

namespace topo::exploration {
namespace {

/// The nearest candidates by cost, and the present one.
std::vector<std::size_t> nearest_of(std::span<const Candidate> candidates, const Candidate* present,
                                    std::size_t most) {
  std::vector<std::size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return candidates[i].cost_m; });
  if (order.size() <= most) return order;
  const auto last = order.begin() + static_cast<std::ptrdiff_t>(most);
  const auto kept = std::find_if(last, order.end(), [&](std::size_t i) { return &candidates[i] == present; });
  if (kept != order.end()) *(last - 1) = *kept;
  order.erase(last, order.end());
  return order;
}

/// From the robot to its start; HUGE_VAL when no route is found.
double way_home_m(const types::Vector2& start, travel::RouteMap& map, const TourParams& params) {
  const travel::CoarseMap& coarse = map.coarse();
  const grid::TravelField& field = map.coarse_field();
  const auto cell = grid::nearest_reachable(coarse.map, field, coarse.map.cell_at(start), params.far_reach_m);
  return cell ? static_cast<double>(field.cost_m[coarse.map.index(*cell)]) : HUGE_VAL;
}

}  // namespace

double expected_area_m2(const goals::Goal& goal, double beyond_m2, const TourParams& params) {
  return std::isinf(goal.behind_m2) ? params.shadow_m2 + goal.chance * beyond_m2 : goal.behind_m2;
}

TravelTable travel_table(std::span<const Candidate> candidates, const Candidate* present,
                         const types::Vector2& start, Searches searches, const TourParams& params) {
  const std::vector<std::size_t> nearest =
      nearest_of(candidates, present, std::max<std::size_t>(params.goals_max, 1));
  const travel::CoarseMap& coarse = searches.map.coarse();
  std::vector<grid::CellIndex> cells;
  cells.reserve(nearest.size() + 1);
  for (const std::size_t i : nearest)
    cells.push_back(coarse.map.cell_at(searches.map.map().centre_of(candidates[i].cell)));
  cells.push_back(coarse.map.cell_at(start));
  searches.ways.update(coarse.map, coarse.clearance_m, searches.map.rules(), cells);
  const std::size_t home = nearest.size();
  const double home_m = way_home_m(start, searches.map, params);
  TravelTable table{std::vector<std::optional<std::size_t>>(candidates.size()), TourGoals(nearest.size()),
                    std::isinf(home_m) ? 0.0 : home_m};
  TourGoals& goals = table.goals;
  for (std::size_t a = 0; a < nearest.size(); ++a) {
    const Candidate& one = candidates[nearest[a]];
    table.row[nearest[a]] = a;
    goals.from_start_m[a] = one.cost_m;
    const double area_m2 = expected_area_m2(one.goal, params.leads_on_m2, params);
    goals.worth[a] = one.goal.side == goals::Side::kNone ? params.gap_share * area_m2 : area_m2;
    // A route through the robot's position always exists.
    if (!std::isinf(home_m))
      goals.to_home_m[a] = std::min(searches.ways.between_m(a, home), one.cost_m + home_m);
    for (std::size_t b = 0; b < nearest.size(); ++b) {
      const double through_here_m = one.cost_m + candidates[nearest[b]].cost_m;
      goals.between(a, b) = a == b ? 0.0 : std::min(searches.ways.between_m(a, b), through_here_m);
    }
  }
  return table;
}

TourGoals rows_of(const TourGoals& goals, std::span<const std::size_t> rows) {
  TourGoals some(rows.size());
  for (std::size_t a = 0; a < rows.size(); ++a) {
    some.from_start_m[a] = goals.from_start_m[rows[a]];
    some.to_home_m[a] = goals.to_home_m[rows[a]];
    some.worth[a] = goals.worth[rows[a]];
    for (std::size_t b = 0; b < rows.size(); ++b) some.between(a, b) = goals.between(rows[a], rows[b]);
  }
  return some;
}

}  // namespace topo::exploration
