// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/exploration/params.hpp"
#include "core/goals/goal.hpp"
#include "core/team/roster.hpp"
#include "core/team/status_message.hpp"
#include "core/types/se2.hpp"
#include "core/types/stamp.hpp"

namespace topo::exploration {

/// The team as input of a decision. A single robot is a team of one: its roster is empty.
struct TeamView {
  std::uint16_t robot = 0;  ///< this one
  const team::Roster& roster;
  std::span<const types::Vector2> going_at;  ///< Roster::going_at() of this period

  /// True when at least one team-mate was ever heard.
  [[nodiscard]] bool has_mates() const { return !roster.empty(); }
};

/// True when a point is on a team-mate that will move on. One that stays is an obstacle like any other.
/// `mate_radius_m`: RosterParams.
bool is_going_mate(std::span<const types::Vector2> going_at, const types::Vector2& p_map,
                   double mate_radius_m);

/// Robots whose claims count, and the claimed goals.
using Claims = std::vector<std::pair<std::uint16_t, std::optional<types::Vector2>>>;
Claims claims_of_mates(const team::Roster& roster, types::Stamp now);
bool are_same_claims(const Claims& a, const Claims& b);

/// True when a team-mate has a goal, or bids for one.
bool mates_have_goals(const team::Roster& roster, types::Stamp now);
/// True when a team-mate, heard or out of reach and not missing, was at a goal and sees nothing more from
/// there. What a missing one saw may never arrive.
bool mate_was_at(const team::Roster& roster, types::Stamp now, const types::Vector2& p_map, double within_m);

/// Position of a goal for the team: its opening, which is the same for all robots. The viewpoint of a robot
/// depends on what else is visible from there, and may be metres away (core/goals/greedy_cover.hpp). Gaps are
/// inspected from beside them.
const types::Vector2& place_for_team(const goals::Goal& goal);
/// The robot's claim on its goal, as team-mates receive it. `claimed_m`: Offer::claimed_m.
team::Bid claim_on(const goals::Goal& goal, double claimed_m);

/// The next metres of a route, thinned out for status messages.
std::vector<types::Vector2> beginning_of(std::span<const types::Vector2> route, const TeamViewParams& params);

/// True when the robot has to slow down for a moving team-mate (core/team/right_of_way.hpp).
bool slows_for_mate(const TeamView& team, const types::Se2& T_map_base, types::Stamp now,
                    const TeamViewParams& params);
/// True when backing off would lead towards a team-mate: the rear has no sensor, and the path behind is
/// occupied.
bool is_mate_behind(const TeamView& team, const types::Se2& T_map_base, types::Stamp now,
                    const TeamViewParams& params);
/// The team-mate to which this robot has to give way; null when there is none. `way`: the next metres of this
/// robot's route.
const team::StatusMessage* who_has_to_pass(const TeamView& team, const types::Se2& T_map_base,
                                           std::span<const types::Vector2> way, types::Stamp now,
                                           const TeamViewParams& params);

}  // namespace topo::exploration
