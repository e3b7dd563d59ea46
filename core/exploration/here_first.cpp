// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/here_first.hpp"

#include <algorithm>

namespace topo::exploration {

Judged here_first(const Judged& all, std::span<const types::Polygon> areas) {
  Judged first;
  if (areas.empty()) return first;
  for (std::size_t i = 0; i < all.candidates.size(); ++i) {
    const types::Vector2& opening = place_for_team(all.candidates[i].goal);
    const bool is_first = std::ranges::any_of(
        areas, [&](const types::Polygon& area) { return types::is_within(area, opening, kBesideArea_m); });
    if (!is_first) continue;
    first.candidates.push_back(all.candidates[i]);
    first.table.row.push_back(all.table.row[i]);
  }
  first.table.goals = all.table.goals;
  first.table.home_m = all.table.home_m;
  return first;
}

}  // namespace topo::exploration
