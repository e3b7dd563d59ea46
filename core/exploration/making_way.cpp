// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>

#include "core/exploration/intent.hpp"
#include "core/exploration/params.hpp"
#include "core/team/right_of_way.hpp"

namespace topo::exploration {
namespace {

using types::Vector2;

/// True when this robot is at home and moves on to the destination of a team-mate that needs to pass
/// (core/team/homes.hpp).
bool moves_up_for(const team::StatusMessage& mate, const Situation& situation, const Intent& intent) {
  if (!is_homing(intent.phase) || situation.mission.order != Order::kExplore) return false;
  team::StatusMessage self;
  self.T_map_base = situation.T_map_base;
  const double at_start_m = situation.team.roster.params().at_start_m;
  return mate.home && intent.offer.home && team::is_at_home(self, *intent.offer.home, at_start_m) &&
         !team::is_at_home(mate, {mate.robot, *mate.home}, at_start_m);
}

const team::StatusMessage* find_mate(std::span<const team::StatusMessage* const> heard, std::uint16_t robot) {
  const auto at = std::find_if(heard.begin(), heard.end(),
                               [&](const team::StatusMessage* mate) { return mate->robot == robot; });
  return at != heard.end() ? *at : nullptr;
}

Intent begin(const team::StatusMessage& mate, const Situation& situation, Intent intent) {
  const Passage passage{mate.robot, situation.here(), situation.now, intent.pursuit.target};
  intent.phase = next(std::move(intent.phase), event::RightOfWay{passage});
  ++intent.pursuit.number;  // control's report on this route does not refer to the goal
  intent.pursuit.turn_to_rad.reset();
  intent.log.note(situation.now, situation.here(), "makes room for robot " + std::to_string(mate.robot));
  return intent;
}

Intent end(const Passage& passage, Intent intent) {
  intent.pursuit.target = passage.target;  // a robot that stands aside is not at its goal
  ++intent.pursuit.number;
  intent.phase = next(std::move(intent.phase), event::Passed{});
  return intent;
}

}  // namespace

Intent give_way(const Situation& situation, Searches searches, const ExplorationParams& params,
                Intent intent) {
  const MakingWayParams& making_way = params.making_way;
  const std::vector<const team::StatusMessage*> heard = situation.team.roster.heard(situation.now);
  if (!std::holds_alternative<MakingWay>(intent.phase)) {
    if (situation.now < intent.offer.ignore_passing_until) return intent;
    const std::vector<Vector2> way =
        intent.pursuit.has_target ? beginning_of(situation.route, params.team_view) : std::vector<Vector2>{};
    const team::StatusMessage* mate =
        who_has_to_pass(situation.team, situation.T_map_base, way, situation.now, params.team_view);
    if (mate == nullptr || moves_up_for(*mate, situation, intent)) return intent;
    intent = begin(*mate, situation, std::move(intent));
  }
  const Passage passage = std::get<MakingWay>(intent.phase).passage;
  const team::StatusMessage* mate = find_mate(heard, passage.mate);
  const bool timed_out = situation.now - passage.since > making_way.at_most;
  if (timed_out) intent.offer.ignore_passing_until = situation.now + making_way.at_most;
  const team::RightOfWayParams& limits = params.team_view.right_of_way;
  const auto in_the_way = [&](const Vector2& p) { return (p - passage.asked_at).norm() < limits.room_m; };
  if (mate == nullptr || timed_out || std::none_of(mate->way_map.begin(), mate->way_map.end(), in_the_way))
    return end(passage, std::move(intent));
  travel::RouteMap& map = searches.map;
  map.settle(limits.detour_ratio * making_way.search_m);
  const auto cell = team::room_beside(map.map(), map.field(), *mate, heard, making_way.search_m, limits);
  Pursuit& pursuit = intent.pursuit;
  pursuit.has_target = cell && (map.map().centre_of(*cell) - situation.here()).norm() > making_way.reached_m;
  if (pursuit.has_target) pursuit.target = *cell;
  pursuit.last_progress = pursuit.taken = situation.now;
  intent.reason = "makes room for robot " + std::to_string(passage.mate);
  return intent;
}

}  // namespace topo::exploration
