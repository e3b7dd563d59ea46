// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/exploration/intent.hpp"
#include "core/exploration/stuck.hpp"
#include "core/grid/nearest_reachable.hpp"
#include "core/travel/closed_way.hpp"
#include "core/types/braking.hpp"

namespace topo::exploration {
namespace {

using types::Vector2;

/// True at the end of a team's exploration; false when the operator orders this robot home.
bool comes_home_with_mates(const Situation& situation) {
  return situation.team.has_mates() && situation.mission.order == Order::kExplore;
}

enum class Outcome : std::uint8_t { kUnderWay, kArrived, kNoProgress };
struct Headed {
  Intent intent;
  Outcome outcome = Outcome::kUnderWay;
};

Intent without_target(Intent intent) {
  intent.pursuit = without_goal(std::move(intent.pursuit));
  intent.pursuit.has_target = false;
  return intent;
}

/// True when the robot is stuck, or has not got on for a while, with a route or without one.
bool is_held(const Situation& situation, const Pursuit& pursuit, const PursuitParams& params) {
  if (!pursuit.goal) return false;
  if (situation.is_about(pursuit) && situation.feedback.stuck) return true;
  const Pursuit now = with_progress(pursuit, situation.here(), situation.now, params);
  return situation.now - now.last_progress > params.standstill;
}

/// Distances from a position at which the robot has arrived: when it drives on, and when it cannot.
struct Reached {
  double usual_m = 0.0;
  double held_m = 0.0;
};

/// To and fro before what closes the way is progress only a few times.
bool gets_on(const Vector2& here, const Attempts& attempts, const ExplorationParams& params) {
  const auto& last = attempts.looked_from;
  return attempts.looks < params.homing.standstills_max || !last ||
         (*last - here).norm() >= params.homing.looks_apart_m;
}

/// Counts a look from where the robot stands, unless it has stood there since the last one.
Attempts with_look(const Vector2& here, bool came, Attempts attempts, double apart_m) {
  const auto& last = attempts.looked_from;
  if (!last || (*last - here).norm() >= apart_m) attempts.looks = 0;
  if (attempts.looks == 0 || came) ++attempts.looks;
  attempts.looked_from = here;
  return attempts;
}

/// No route leads home: what closes the way by which the robot came may be gone, as a person or a mate that
/// is not heard. From near by the robot sees that (RouteMap::begin). `came`: it had somewhere to go until
/// now.
Intent look_at_closed_way(const Situation& situation, travel::RouteMap& map, const HomingParams& params,
                          bool came, Intent intent) {
  const auto way = travel::closed_way(map.map(), map.field(),
                                      travel::positions_of(situation.driven, map.params().keyframe_gap_m),
                                      params.look_from_m);
  if (!way) return intent;
  intent.reason = "no way there just now: looks at what closes the way by which the robot came";
  Pursuit going = aimed_at(way->look_from, map, intent.pursuit);
  const Vector2 here = situation.here();
  if (going.has_target && (map.map().centre_of(going.target) - here).norm() > params.stuck_reached_m) {
    going.turn_to_rad.reset();
    intent.pursuit = std::move(going);
    return intent;
  }
  intent.attempts = with_look(here, came, std::move(intent.attempts), params.looks_apart_m);
  const Vector2 to = way->closed_at - here;
  intent.pursuit.turn_to_rad = std::atan2(to.y(), to.x());
  return intent;
}

/// One decision on the route to a position.
Headed head_for(const Vector2& p_map, const Reached& reached, const Situation& situation,
                travel::RouteMap& map, const ExplorationParams& params, Intent intent) {
  if (!intent.pursuit.goal) {
    goals::Goal place;
    place.p_map = p_map;
    intent.pursuit = set_out(std::move(intent.pursuit), place, {}, situation.now, situation.here());
  }
  const bool about_this = situation.is_about(intent.pursuit);
  const double away_m = (p_map - situation.here()).norm();
  const bool held = is_held(situation, intent.pursuit, params.pursuit);
  const double reached_m = held ? std::max(reached.usual_m, reached.held_m) : reached.usual_m;
  const double ended_m = 2.0 * reached.usual_m + params.homing.arrived_slack_m;
  const double rolls_m = std::abs(types::braking_m(situation.feedback.v_mps, params.homing.brakes_mps2));
  const bool passes = !held && away_m + rolls_m > params.homing.stuck_reached_m;
  if ((away_m <= reached_m && !passes) || (about_this && situation.feedback.arrived && away_m <= ended_m))
    return {without_target(std::move(intent)), Outcome::kArrived};
  if (about_this && situation.feedback.stuck) {
    intent = block_ahead(situation, map, params.pursuit, std::move(intent));
    ++intent.pursuit.number;  // makes control start anew, on another route
  }
  if (gets_on(situation.here(), intent.attempts, params))
    intent.pursuit =
        with_progress(std::move(intent.pursuit), situation.here(), situation.now, params.pursuit);
  if (situation.now - intent.pursuit.last_progress >
      params.homing.standstills_max * params.pursuit.standstill)
    return {without_target(std::move(intent)), Outcome::kNoProgress};
  const bool came = intent.pursuit.has_target;
  intent.pursuit = aimed_at(p_map, map, std::move(intent.pursuit));
  if (intent.pursuit.has_target) {
    intent.pursuit.turn_to_rad.reset();
    return {std::move(intent), Outcome::kUnderWay};
  }
  intent.reason = "no way there just now";
  (void)intent.obstacles.forget(situation.now);
  intent.obstacles.open_passages();  // a passage too tight for exploration may be the only route home
  if (std::holds_alternative<GoingTo>(intent.phase)) return {std::move(intent), Outcome::kUnderWay};
  return {look_at_closed_way(situation, map, params.homing, came, std::move(intent)), Outcome::kUnderWay};
}

struct Destination {
  std::optional<team::Home> home;    ///< a start: the robot's own or a team-mate's
  std::optional<team::Home> before;  ///< the previous one, if a route leads there
  Vector2 p_map{0.0, 0.0};
};

/// The robot's start; in a team, one of the starts of all robots.
Destination destination(const Situation& situation, travel::RouteMap& map, const ExplorationParams& params,
                        const Pursuit& pursuit, const Offer& offer) {
  if (!comes_home_with_mates(situation)) return {offer.home, offer.home, situation.start};
  team::StatusMessage self;
  self.robot = situation.team.robot;
  self.start = situation.start;
  self.T_map_base = situation.T_map_base;
  const auto cell_at = [&](const Vector2& p) {
    return grid::nearest_reachable(map.map(), map.field(), map.map().cell_at(p),
                                   params.homing.home_reached_m);
  };
  const auto cost_m = [&](const Vector2& p) {
    map.settle(HUGE_VAL);
    const auto cell = cell_at(p);
    return cell ? static_cast<double>(map.field().cost_m[map.map().index(*cell)]) : HUGE_VAL;
  };
  std::optional<team::Home> present = offer.home;
  if (present) map.settle(params.homing.home_reached_m);
  if (present && !cell_at(present->p_map)) present.reset();
  const team::Roster& roster = situation.team.roster;
  const std::vector<const team::StatusMessage*> mates = roster.heard(situation.now);
  const double at_start_m = roster.params().at_start_m;
  // Mates that are home may shut off the start that is farther in: then the one where the robot stands will
  // do.
  if (is_held(situation, pursuit, params.pursuit)) {
    if (const auto here = team::start_beside(self, mates, at_start_m)) present = here;
  }
  const team::StatusMessage* passing = nullptr;
  if (situation.now >= offer.ignore_passing_until) {
    const std::vector<Vector2> way =
        pursuit.has_target ? beginning_of(situation.route, params.team_view) : std::vector<Vector2>{};
    passing = who_has_to_pass(situation.team, situation.T_map_base, way, situation.now, params.team_view);
  }
  const auto home = team::choose_home(self, mates, present, passing, cost_m, at_start_m);
  return {home, present, home ? home->p_map : situation.start};
}

/// A change of home changes the route: control's report then refers to the old one.
Intent bound_for(const std::optional<team::Home>& home, const std::optional<team::Home>& before,
                 Intent intent) {
  const bool same = home && before ? home->robot == before->robot : !home && !before;
  if (!same && intent.pursuit.goal) {
    intent.pursuit = without_goal(std::move(intent.pursuit));
    intent.is_outdated = true;
  }
  intent.offer.home = home;
  return intent;
}

/// The reason shown after the mission.
std::string reason_at_home(const Phase& phase, Order order) {
  const auto& way = std::get<Returning>(phase);
  if (way.cut_short) return way.why + ": came home";
  return order == Order::kExplore ? way.why : "arrived";
}

Intent arrive_home(const Situation& situation, Intent intent) {
  if (comes_home_with_mates(situation) && !situation.team.roster.all_home(situation.now)) {
    intent.phase = next(std::move(intent.phase), event::MatesOut{});
    intent.reason = "home, waits for the others";
    return intent;
  }
  intent.reason = reason_at_home(intent.phase, situation.mission.order);
  intent.phase = next(std::move(intent.phase), event::Arrived{});
  return intent;
}

Intent fail(Intent intent) {
  intent.phase = next(std::move(intent.phase), event::NoProgress{});
  intent.reason = "no progress for 100 s";
  return intent;
}

}  // namespace

Intent go_home(const Situation& situation, Searches searches, const ExplorationParams& params,
               Intent intent) {
  intent.reason = std::get<Returning>(intent.phase).why;
  const HomingParams& homing = params.homing;
  const bool in_team = comes_home_with_mates(situation);
  // Among mates that are home, a robot that gets no nearer is there when it leaves no room for another.
  const Reached reached = in_team
                              ? Reached{homing.team_home_reached_m, situation.team.roster.params().at_start_m}
                              : Reached{homing.home_reached_m, homing.stuck_reached_m};
  const Destination to = destination(situation, searches.map, params, intent.pursuit, intent.offer);
  intent = bound_for(to.home, to.before, std::move(intent));
  Headed headed = head_for(to.p_map, reached, situation, searches.map, params, std::move(intent));
  switch (headed.outcome) {
    case Outcome::kUnderWay:
      return std::move(headed.intent);
    case Outcome::kArrived:
      return arrive_home(situation, std::move(headed.intent));
    case Outcome::kNoProgress:
      return fail(std::move(headed.intent));
  }
  return std::move(headed.intent);
}

Intent go_to_target(const Situation& situation, Searches searches, const ExplorationParams& params,
                    Intent intent) {
  intent.reason = "on the operator's order";
  Headed headed = head_for(situation.mission.target, {params.homing.home_reached_m, 0.0}, situation,
                           searches.map, params, std::move(intent));
  if (headed.outcome == Outcome::kNoProgress) return fail(std::move(headed.intent));
  if (headed.outcome == Outcome::kArrived) {
    headed.intent.phase = next(std::move(headed.intent.phase), event::Arrived{});
    headed.intent.reason = "arrived";
  }
  return std::move(headed.intent);
}

}  // namespace topo::exploration
