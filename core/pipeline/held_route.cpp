// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/held_route.hpp"

#include <algorithm>
#include <utility>

#include "core/travel/path.hpp"

namespace topo::pipeline {
namespace {

using types::Vector2;

/// True when more is known than at the decision: in total, or around the goal, where one scan through a door
/// may complete the map.
bool has_changed(const HeldRoute& route, const Vector2& goal, const MapSnapshot& now,
                 const travel::RouteMap& map, const RouteHoldParams& params) {
  const double cell_m2 = map.map().resolution_m * map.map().resolution_m;
  return static_cast<double>(now.changed_cells - route.changed_cells) * cell_m2 >= params.changed_m2 ||
         travel::newly_known_m2(map.map(), now.grid, goal, params.around_goal_m) >= params.changed_at_goal_m2;
}

/// True when a team-mate needs to pass, and the robot does not stand aside yet.
bool has_to_give_way(const exploration::Intent& intent, const exploration::TeamView& team,
                     const Whereabouts& place, std::span<const Vector2> route, types::Stamp now,
                     const exploration::TeamViewParams& params) {
  if (std::holds_alternative<exploration::MakingWay>(intent.phase) || now < intent.offer.ignore_passing_until)
    return false;
  const auto way =
      intent.pursuit.has_target ? exploration::beginning_of(route, params) : std::vector<Vector2>{};
  return exploration::who_has_to_pass(team, place.pose(), way, now, params) != nullptr;
}

/// True when a team-mate has claimed the robot's goal since the decision, and the robot has to leave it.
bool is_lost_to_a_mate(const HeldRoute& route, const exploration::Intent& intent,
                       const exploration::TeamView& team, types::Stamp now) {
  std::vector<const team::StatusMessage*> claimants = team.roster.counted(now);
  std::erase_if(claimants, [&](const team::StatusMessage* mate) {
    return !mate->claim ||
           std::ranges::count(route.claims, std::pair(mate->robot, std::optional(mate->claim->p_map))) > 0;
  });
  const team::Bid own = exploration::claim_on(*intent.pursuit.goal, intent.offer.claimed_m);
  return team::is_beaten(own, team.robot, claimants);
}

bool is_in_the_way(std::span<const Vector2> ahead, const Vector2& obstacle, double closed_m) {
  return std::any_of(ahead.begin(), ahead.end(),
                     [&](const Vector2& p) { return (p - obstacle).squaredNorm() < closed_m * closed_m; });
}

}  // namespace

bool holds(const HeldRoute& route, const exploration::Intent& intent, const exploration::TeamView& team,
           const Whereabouts& place, const PlanningInput& in, const travel::RouteMap& map, bool battery_low,
           std::span<const Vector2> seen_now, const PlannerParams& params) {
  const exploration::Pursuit& pursuit = intent.pursuit;
  if (!pursuit.has_target || !pursuit.goal || route.points.size() < 2) return false;
  const RouteHoldParams& hold = params.hold;
  const types::Duration since = in.now - route.decided;
  const bool may_be_quiet = since < hold.quiet_decision_holds;
  if (since >= hold.decision_holds &&
      (!may_be_quiet || has_changed(route, pursuit.goal->p_map, *in.map, map, hold) ||
       !exploration::are_same_claims(exploration::claims_of_mates(team.roster, in.now), route.claims)))
    return false;
  if (battery_low && !exploration::is_homing(intent.phase)) return false;
  if (is_lost_to_a_mate(route, intent, team, in.now)) return false;
  if (has_to_give_way(intent, team, place, route.points, in.now, params.explore.team_view)) return false;
  if (exploration::is_seeking_contact(intent.phase) && !intent.contact.lost_at(in.now)) return false;
  if (in.control->mode == ControlMode::kStuck || in.control->mode == ControlMode::kArrived) return false;
  if (route.newest.is_bent(*in.map, hold.correction_m, hold.correction_rad)) return false;
  const Vector2 here = place.here();
  if ((route.points.back() - here).norm() <= params.explore.pursuit.goal_reached_m) return false;
  const travel::PathParams& path = params.route_map.path;
  const std::size_t from = travel::nearest_point(route.points, here, path);
  if ((route.points[from] - here).norm() > hold.off_route_m) return false;
  const std::size_t near_points = std::min(route.points.size() - from, path.near_points);
  const std::span<const Vector2> ahead = std::span(route.points).subspan(from, near_points);
  const double closed_m = params.travel.radius_m - map.map().resolution_m;
  return std::none_of(seen_now.begin(), seen_now.end(), [&](const Vector2& obstacle) {
    const bool is_there_already = (obstacle - here).norm() <= closed_m;
    return !is_there_already && is_in_the_way(ahead, obstacle, closed_m);
  });
}

HeldRoute trimmed(HeldRoute route, const Vector2& here, const travel::PathParams& path) {
  const auto passed = static_cast<std::ptrdiff_t>(travel::nearest_point(route.points, here, path));
  route.points.erase(route.points.begin(), route.points.begin() + passed);
  return route;
}

}  // namespace topo::pipeline
