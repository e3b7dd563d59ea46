// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/planning_report.hpp"

namespace topo::pipeline {
namespace {

using exploration::Intent;
using exploration::Phase;

bool is_paused(const Phase& phase) { return std::holds_alternative<exploration::Paused>(phase); }

team::Duty duty_of(const PlanningInput& in, const Phase& phase, const Whereabouts& place) {
  if (has_ended(phase) || is_waiting_at_home(phase)) return team::Duty::kOver;
  const bool able = place.located && !in.control->estop_latched && !is_paused(phase) &&
                    in.mission.order == exploration::Order::kExplore;
  return able ? team::Duty::kAble : team::Duty::kUnable;
}

}  // namespace

Activity activity_of(const Phase& phase, bool has_goal, bool is_hindered) {
  if (std::holds_alternative<exploration::Idle>(phase)) return Activity::kIdle;
  if (std::holds_alternative<exploration::Done>(phase)) return Activity::kDone;
  if (std::holds_alternative<exploration::Failed>(phase)) return Activity::kFailed;
  if (is_hindered) return Activity::kThinking;
  if (is_paused(phase)) return Activity::kPaused;
  if (is_homing(phase)) return Activity::kReturning;
  if (std::holds_alternative<exploration::GoingTo>(phase)) return Activity::kGoingTo;
  return has_goal ? Activity::kExploring : Activity::kThinking;
}

Plan make_plan(std::uint64_t sequence, const PlanningInput& in, const Intent& intent,
               const Whereabouts& place, std::span<const types::Vector2> route,
               const exploration::TeamView& team, const PlannerParams& params) {
  Plan plan;
  plan.stamp = in.now;
  plan.sequence = sequence;
  plan.goal_id = intent.pursuit.number;
  plan.activity = activity_of(intent.phase, intent.pursuit.goal.has_value(), !place.missing.empty());
  plan.T_map_odom = place.T_map_odom;
  plan.bends = place.bends;
  plan.located = place.located;
  if (!place.missing.empty() || has_ended(intent.phase) || is_paused(intent.phase)) return plan;
  const bool turns = !intent.pursuit.has_target && intent.pursuit.turn_to_rad;
  if (!turns && (!intent.pursuit.has_target || route.size() < 2)) return plan;
  plan.moving = true;
  if (slows_for_mate(team, place.pose(), in.now, params.explore.team_view))
    plan.v_max_mps = params.v_beside_mate_mps;
  plan.mate_behind = is_mate_behind(team, place.pose(), in.now, params.explore.team_view);
  if (turns)
    plan.turn_to_rad = types::wrap_angle(*intent.pursuit.turn_to_rad - place.T_map_odom.se2().theta_rad);
  else
    put_path(route, place.T_map_odom, plan);
  return plan;
}

std::unique_ptr<PlanningReport> make_report(const PlanningInput& in, const Intent& intent,
                                            const Whereabouts& place, std::span<const types::Vector2> route) {
  auto report = std::make_unique<PlanningReport>();
  report->stamp = in.now;
  report->activity = activity_of(intent.phase, intent.pursuit.goal.has_value(), !place.missing.empty());
  report->reason = !place.missing.empty()    ? place.missing
                   : is_paused(intent.phase) ? "paused by the operator"
                                             : intent.reason;
  report->mission = in.mission.number;
  report->mission_ended = has_ended(intent.phase);
  report->second_phase = intent.outlook.only_gaps;
  report->T_map_base = place.T_map_base;
  report->T_map_start = place.T_map_start;
  report->open_goals = intent.outlook.open_goals;
  report->deferred = intent.deferred.held(in.now);
  report->decisions = intent.log.decisions;
  report->goal = intent.pursuit.goal;
  report->route_map.assign(route.begin(), route.end());
  report->frontier_clusters = intent.outlook.clusters;
  report->goals_issued = intent.log.goals_issued;
  report->decisions_made = intent.log.decisions_made;
  report->clusters_sum = intent.log.clusters_sum;
  report->goals_sum = intent.log.goals_sum;
  return report;
}

team::StatusMessage make_message(const PlanningInput& in, const Intent& intent, const Whereabouts& place,
                                 std::span<const types::Vector2> route, const PlannerParams& params) {
  const Phase& phase = intent.phase;
  team::StatusMessage message;
  message.robot = in.team.robot;
  message.T_map_base = place.pose();
  message.start = place.T_map_start.se2().translation();
  if (is_homing(phase) && intent.offer.home) message.home = intent.offer.home->p_map;
  message.duty = duty_of(in, phase, place);
  if (intent.pursuit.has_target) message.way_map = exploration::beginning_of(route, params.explore.team_view);
  message.visited = intent.deferred.visited(in.now);
  message.looked = intent.sweep.sweep.looked();
  // An unable robot keeps its claim: team-mates decide by the duration of that state (roster.hpp).
  if (has_ended(phase) || is_homing(phase) || in.mission.order != exploration::Order::kExplore)
    return message;
  message.bids = intent.offer.bids;
  if (intent.pursuit.goal && !is_seeking_contact(phase))
    message.claim = exploration::claim_on(*intent.pursuit.goal, intent.offer.claimed_m);
  return message;
}

}  // namespace topo::pipeline
