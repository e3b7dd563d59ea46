// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/team_view.hpp"

#include <algorithm>

#include "core/team/right_of_way.hpp"

namespace topo::exploration {

using types::Vector2;

bool is_going_mate(std::span<const Vector2> going_at, const Vector2& p_map, double mate_radius_m) {
  return std::any_of(going_at.begin(), going_at.end(),
                     [&](const Vector2& mate) { return (mate - p_map).norm() <= mate_radius_m; });
}

Claims claims_of_mates(const team::Roster& roster, types::Stamp now) {
  Claims claims;
  for (const team::StatusMessage* mate : roster.counted(now)) {
    const auto claimed = mate->claim ? std::optional(mate->claim->p_map) : std::nullopt;
    claims.emplace_back(mate->robot, claimed);
  }
  return claims;
}

bool are_same_claims(const Claims& a, const Claims& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    if (x.first != y.first || x.second.has_value() != y.second.has_value()) return false;
    return !x.second || team::is_same_goal(*x.second, *y.second);
  });
}

bool mates_have_goals(const team::Roster& roster, types::Stamp now) {
  const auto counted = roster.counted(now);
  return std::any_of(counted.begin(), counted.end(),
                     [](const team::StatusMessage* mate) { return mate->claim || !mate->bids.empty(); });
}

bool mate_was_at(const team::Roster& roster, types::Stamp now, const Vector2& p_map, double within_m) {
  const auto mates = roster.not_missing(now);
  return std::any_of(mates.begin(), mates.end(), [&](const team::StatusMessage* mate) {
    return std::any_of(mate->visited.begin(), mate->visited.end(),
                       [&](const Vector2& p) { return (p - p_map).norm() <= within_m; });
  });
}

const Vector2& place_for_team(const goals::Goal& goal) {
  return goal.side != goals::Side::kNone ? goal.opening : goal.p_map;
}

team::Bid claim_on(const goals::Goal& goal, double claimed_m) {
  return team::in_steps({place_for_team(goal), claimed_m, true});
}

std::vector<Vector2> beginning_of(std::span<const Vector2> route, const TeamViewParams& params) {
  std::vector<Vector2> way;
  double gone_m = 0.0, next_m = 0.0;
  for (std::size_t i = 0; i < route.size() && gone_m <= params.way_m; ++i) {
    if (i > 0) gone_m += (route[i] - route[i - 1]).norm();
    if (gone_m < next_m) continue;
    way.push_back(route[i]);
    next_m = gone_m + params.way_spacing_m;
  }
  return way;
}

bool slows_for_mate(const TeamView& team, const types::Se2& T_map_base, types::Stamp now,
                    const TeamViewParams& params) {
  team::StatusMessage self;
  self.robot = team.robot;
  self.T_map_base = T_map_base;
  const auto heard = team.roster.heard(now);
  return std::any_of(heard.begin(), heard.end(), [&](const team::StatusMessage* mate) {
    return team::slows_for(self, *mate, types::to_seconds(team.roster.age_of(*mate, now)),
                           params.right_of_way);
  });
}

bool is_mate_behind(const TeamView& team, const types::Se2& T_map_base, types::Stamp now,
                    const TeamViewParams& params) {
  const auto heard = team.roster.heard(now);
  return std::any_of(heard.begin(), heard.end(), [&](const team::StatusMessage* mate) {
    const Vector2 at = T_map_base.inverse() * mate->T_map_base.translation();
    return at.x() < 0.0 && at.norm() <= params.behind_m;
  });
}

const team::StatusMessage* who_has_to_pass(const TeamView& team, const types::Se2& T_map_base,
                                           std::span<const Vector2> way, types::Stamp now,
                                           const TeamViewParams& params) {
  team::StatusMessage self;
  self.robot = team.robot;
  self.T_map_base = T_map_base;
  self.way_map.assign(way.begin(), way.end());
  return team::who_needs_room(self, team.roster.heard(now), params.right_of_way);
}

}  // namespace topo::exploration
