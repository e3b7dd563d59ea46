// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/stuck.hpp"

namespace topo::exploration {

using types::Vector2;

Intent block_ahead(const Situation& situation, const travel::RouteMap& map, const PursuitParams& params,
                   Intent intent) {
  const types::Se2& T_map_base = situation.T_map_base;
  const TeamView& team = situation.team;
  if (is_going_mate(team.going_at, T_map_base * Vector2(params.mate_ahead_m, 0.0),
                    team.roster.params().mate_radius_m))
    return intent;
  if (const auto tight = map.tight_ahead(situation.route, situation.here()))
    intent.obstacles.close_passage(*tight);
  else
    intent.obstacles.block(T_map_base * Vector2(params.blocked_ahead_m, 0.0), situation.now);
  intent.is_outdated = true;
  return intent;
}

Pursuit aimed_at(const Vector2& p_map, travel::RouteMap& map, Pursuit pursuit) {
  const auto cell = map.reachable_cell(p_map);
  pursuit.has_target = cell.has_value();
  if (cell) pursuit.target = *cell;
  return pursuit;
}

}  // namespace topo::exploration
