// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/opening_chance.hpp"

#include <algorithm>
#include <cmath>

namespace topo::goals {

double chance_to_lead_on(double opening_m, double from_paths_m, const ChanceParams& params) {
  const double away_m = std::min(from_paths_m, params.far_m) + params.near_m;
  const double odds = opening_m * std::pow(away_m, params.power) / params.even_at;
  return odds / (1.0 + odds);
}

double distance_from_paths_m(const types::Vector2& p_map,
                             std::span<const std::vector<types::Vector2>> paths) {
  double nearest_m2 = HUGE_VAL;
  for (const std::vector<types::Vector2>& path : paths) {
    for (const types::Vector2& p : path) nearest_m2 = std::min(nearest_m2, (p - p_map).squaredNorm());
  }
  return std::sqrt(nearest_m2);
}

}  // namespace topo::goals
