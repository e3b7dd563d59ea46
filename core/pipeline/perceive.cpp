// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/perceive.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/travel/seen_through.hpp"
#include "core/travel/travel_map.hpp"

namespace topo::pipeline {

using exploration::Intent;
using exploration::is_going_mate;
using types::Stamp;
using types::Vector2;

Intent ordered(Intent intent, std::uint64_t mission, const PlanningInput& in) {
  if (in.mission.number != mission) intent = begin_mission(std::move(intent), in.mission.order, in.now);
  const exploration::Event pause = exploration::event::PauseOrdered{},
                           resume = exploration::event::ResumeOrdered{};
  intent.phase = next(std::move(intent.phase), in.mission.paused ? pause : resume);
  return intent;
}

Heard heard(Heard before, const PlanningInput& in, const Vector2& here) {
  auto& [team, contact] = before;
  for (const team::StatusMessage& message : in.team.messages) {
    const bool newer = message.robot != in.team.robot && team.roster.take(message, in.now);
    if (newer && message.duty != team::Duty::kOver) contact.heard(here, in.now);
  }
  if (!team.roster.any_at_work()) contact.forget();
  team.going_at = team.roster.going_at(in.now);
  return before;
}

Battery watched(Battery battery, const ControlReport& control, const types::BatteryLimits& limits,
                Stamp now) {
  const bool low = types::is_battery_low(control.battery_v, control.state_of_charge, limits);
  if (!low) battery.low_since = {};
  if (low && battery.low_since == Stamp{}) battery.low_since = now;
  battery.low = battery.low || (low && now - battery.low_since >= types::kBatteryLowFor);
  return battery;
}

Intent felt(Intent intent, const PlanningInput& in, const Whereabouts& place,
            std::span<const Vector2> going_at, bool touched, const PlannerParams& params) {
  const double mate_radius_m = params.roster.mate_radius_m;
  const types::Se2 T_map_odom = place.T_map_odom.se2();
  const ControlReport& control = *in.control;
  intent.obstacles.expire(in.now);
  for (std::size_t i = 0; i < std::min<std::size_t>(control.unseen, control.unseen_odom.size()); ++i) {
    const Vector2 p_map = T_map_odom * control.unseen_odom[i];
    if (!is_going_mate(going_at, p_map, mate_radius_m)) intent.obstacles.note_echo(p_map, in.now);
  }
  const Vector2 p_map = T_map_odom * control.touched_odom;
  if (!touched || is_going_mate(going_at, p_map, mate_radius_m)) return intent;
  intent.obstacles.note_touch(p_map, in.now);
  intent.log.note(in.now, p_map, "touched something here");
  intent.is_outdated = true;
  return intent;
}

namespace {

/// The newest scan of the front scanner, unless it is too old to say what is there now.
const types::Scan* live_scan(const PlanningInput& in, const PlannerParams& params) {
  return in.front != nullptr && in.now - in.front->arrival <= params.live_age_max ? in.front : nullptr;
}

}  // namespace

std::vector<Vector2> seen_now(const PlanningInput& in, const Whereabouts& place,
                              std::span<const Vector2> going_at, const PlannerParams& params) {
  const types::Scan* const scan = live_scan(in, params);
  if (scan == nullptr) return {};
  std::vector<Vector2> points = travel::confirmed_points(
      *scan, place.pose() * params.T_base_laser, params.route_map.live_range_m, params.route_map.live_step_m);
  const double radius_m = params.roster.mate_radius_m;
  if (!going_at.empty())
    std::erase_if(points, [&](const Vector2& p) { return is_going_mate(going_at, p, radius_m); });
  return points;
}

std::vector<Vector2> seen_through(const PlanningInput& in, const Whereabouts& place,
                                  const grid::DenseMap& map, const travel::DrivenWays& ways,
                                  const PlannerParams& params) {
  const types::Scan* const scan = live_scan(in, params);
  if (scan == nullptr || std::abs(in.control->odometry.twist.omega_radps) > params.see_through_radps)
    return {};
  return travel::seen_through(*scan, place.pose() * params.T_base_laser, map, ways, params.route_map);
}

}  // namespace topo::pipeline
