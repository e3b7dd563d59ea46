// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/plan_following.hpp"

#include <algorithm>
#include <cmath>

#include "core/perception/stop_zone.hpp"
#include "core/types/braking.hpp"
#include "core/types/invariant.hpp"

namespace topo::pipeline {
namespace {

using motion::GateReason;
using motion::RecoveryPhase;
using types::Se2;
using types::Twist2;

/// True for reasons that lie in the surroundings, not in the robot's state.
bool is_in_the_way(GateReason reason) {
  return reason == GateReason::kBlocked || reason == GateReason::kAreaLimit;
}

bool is_touch(GateReason reason) { return reason == GateReason::kStall || reason == GateReason::kBumper; }

bool lets_move(GateReason reason) {
  return reason == GateReason::kFree || reason == GateReason::kLimited || reason == GateReason::kSlowed;
}

/// True when a moving obstacle is the only reason to stop, or is close to a robot without a free path.
bool is_held_up(bool blocked, GateReason last, std::span<const perception::MovingObstacle> moving,
                double beside_m) {
  if (last == GateReason::kGivesWay) return true;
  return (blocked || is_in_the_way(last)) && !moving.empty() && moving.front().centre.norm() < beside_m;
}

/// True when motion is denied. A turn that slows down more and more towards a corner takes time and leads
/// nowhere.
bool lets_nothing_through(const Granted& last, const PlanFollowingParams& params) {
  const bool turns = last.wished.v_mps == 0.0 && std::abs(last.wished.omega_radps) > params.turns_radps;
  return !lets_move(last.reason) || (turns && std::abs(last.given.omega_radps) < params.hardly_radps);
}

ControlMode mode_of(RecoveryPhase phase) {
  switch (phase) {
    case RecoveryPhase::kNone:
      return ControlMode::kFollowing;
    case RecoveryPhase::kWaiting:
      return ControlMode::kWaiting;
    case RecoveryPhase::kBacking:
    case RecoveryPhase::kEasing:
    case RecoveryPhase::kTurning:
    case RecoveryPhase::kLeaving:
      return ControlMode::kRecovering;
    case RecoveryPhase::kStuck:
      return ControlMode::kStuck;
  }
  return ControlMode::kStuck;
}

std::size_t points_of(const Plan& plan) { return std::min<std::size_t>(plan.points, Plan::kMaxPoints); }
const types::Vector2& end_of(const Plan& plan) {
  types::require(plan.points > 0, "pipeline::PlanFollowing: a plan without points");
  return plan.path_odom[points_of(plan) - 1];
}

/// The arrival; cleared when the plan no longer ends there.
Arrival kept(Arrival arrival, const Plan& plan, double same_end_m) {
  arrival.arrived = arrival.arrived && arrival.goal == plan.goal_id && !plan.turn_to_rad &&
                    plan.path_ends_at_goal && (end_of(plan) - arrival.at_odom).norm() < same_end_m;
  return arrival;
}

/// True when the last gate decision leaves it to path following to move on.
bool is_able(const motion::GateInput& gate_in, GateReason last) {
  return gate_in.base != nullptr && gate_in.front_scan != nullptr && motion::is_finite(*gate_in.base) &&
         (lets_move(last) || is_in_the_way(last) || is_touch(last) || last == GateReason::kGivesWay);
}

/// Free distance straight ahead.
double ahead_m(const motion::GateInput& gate_in) {
  const Twist2 on{gate_in.limits.v_reverse_max_mps, 0.0};
  return perception::free_distance_m(
      on, perception::free_time_s(on, gate_in.limits, motion::surroundings(gate_in)));
}

}  // namespace

PlanFollowing::PlanFollowing(const PlanFollowingParams& params, const motion::MotionParams& motion)
    : params_(params),
      seen_behind_max_m_(motion.recovery.ease.seen_max_m),
      follower_(motion.follower),
      recovery_(motion.recovery),
      yielding_(motion.yielding),
      no_breadcrumbs_(motion.breadcrumbs) {}

bool is_touching(const types::BaseState& b) {
  return b.bumpers_front != 0 || b.bumpers_rear != 0 || b.stall_left || b.stall_right;
}

void PlanFollowing::rest(types::Stamp now) {
  follower_.reset();
  recovery_.pause(now);
  recovering_ = false;
}

ObstacleReach obstacle_reach(const types::RobotLimits& limits, double blind_s,
                             const PlanFollowingParams& params) {
  const double stop_m =
      limits.v_max_mps * blind_s + types::braking_m(limits.v_max_mps, limits.deceleration_mps2);
  const double reach_m = std::max(params.obstacle_reach_m, stop_m + types::reach_m(limits.footprint));
  return {reach_m, params.obstacle_spacing_m * reach_m / params.obstacle_reach_m};
}

motion::FollowOutput PlanFollowing::way(const Plan& plan, const Se2& T_odom_base,
                                        const motion::GateInput& gate_in, const Twist2& given) {
  motion::FollowInput f;
  f.blind_s = motion::blind_time_s(gate_in);
  f.alive_s = motion::alive_time_s(gate_in);
  const ObstacleReach reach = obstacle_reach(gate_in.limits, f.blind_s, params_);
  const std::size_t count = perception::collect_obstacles(gate_in.limits, motion::surroundings(gate_in),
                                                          reach.reach_m, reach.spacing_m, obstacles_);
  f.T_odom_base = T_odom_base;
  f.twist = given;
  f.path_odom = {plan.path_odom.data(), points_of(plan)};
  f.path_number = plan.sequence;
  f.ends_at_goal = plan.path_ends_at_goal;
  f.turn_to_rad = plan.turn_to_rad;
  f.obstacles_base = {obstacles_.data(), count};
  types::RobotLimits limits = gate_in.limits;
  limits.v_max_mps = std::min(limits.v_max_mps, plan.v_max_mps);
  f.limits = &limits;
  f.contact = gate_in.stop_zone.contact;
  return follower_.step(f);
}

motion::RecoveryOutput PlanFollowing::rescue(const Plan& plan, const motion::FollowOutput& out,
                                             const Se2& T_odom_base, const motion::GateInput& gate_in,
                                             const ControlSenses& senses, const Granted& last) {
  motion::RecoveryInput r;
  r.now = gate_in.now;
  r.goal_id = plan.goal_id;
  r.T_odom_base = T_odom_base;
  r.blocked = out.blocked || (!recovering_ && is_in_the_way(last.reason));
  r.touching = is_touching(*gate_in.base);
  r.refused = recovering_ && lets_nothing_through(last, params_);
  r.turn_rad = out.turn_rad;
  r.blind_s = motion::blind_time_s(gate_in);
  // Only a recovery needs these values.
  r.ahead_m = recovering_ ? ahead_m(gate_in) : 0.0;
  r.seen_behind_m =
      recovering_ && !plan.mate_behind ? senses.seen_behind_m(gate_in, seen_behind_max_m_) : 0.0;
  r.trail = plan.mate_behind ? &no_breadcrumbs_ : &senses.breadcrumbs();
  r.limits = &gate_in.limits;
  return recovery_.step(r);
}

Wish PlanFollowing::follow(const Plan& plan, const motion::GateInput& gate_in, const ControlSenses& senses,
                           const Granted& last) {
  Wish wish{ControlMode::kFollowing, {}, true};
  arrival_ = kept(arrival_, plan, params_.same_end_m);
  if (arrival_.arrived) {
    recovery_.pause(gate_in.now);
    return {ControlMode::kArrived, {}, false};
  }
  if (!is_able(gate_in, last.reason)) {  // the gate reports the reason, which is not an obstacle
    recovery_.pause(gate_in.now);
    return wish;
  }
  const Se2 T_odom_base = perception::pose_at(gate_in.base->odometry, gate_in.now);
  const motion::FollowOutput out = way(plan, T_odom_base, gate_in, last.given);
  yielding_.update(gate_in.now, is_held_up(out.blocked, last.reason, gate_in.moving, params_.beside_m),
                   gate_in.moving);
  if (!recovering_ && !out.arrived && (yielding_.waits() || yielding_.lets_go_first())) {
    recovery_.pause(gate_in.now);
    wish.mode = ControlMode::kWaiting;
    if (yielding_.waits()) wish.twist = out.twist;
    return wish;
  }
  const motion::RecoveryOutput rescued = rescue(plan, out, T_odom_base, gate_in, senses, last);
  wish.mode = mode_of(rescued.phase);
  recovering_ = wish.mode == ControlMode::kRecovering;
  const bool may_go = rescued.phase == RecoveryPhase::kNone || rescued.phase == RecoveryPhase::kWaiting;
  wish.twist = may_go ? out.twist : rescued.twist;
  wish.backing = rescued.backing;
  if (may_go && out.arrived) {
    if (!plan.turn_to_rad) arrival_ = {true, plan.goal_id, end_of(plan)};
    wish.mode = ControlMode::kArrived;
  }
  return wish;
}

}  // namespace topo::pipeline
