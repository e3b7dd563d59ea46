// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/control_step.hpp"

#include <algorithm>

#include "core/pipeline/control_evidence.hpp"
#include "core/pipeline/control_senses.hpp"
#include "core/pipeline/plan_following.hpp"
#include "core/pipeline/wish.hpp"

namespace topo::pipeline {
namespace {

using types::Stamp;
using types::Twist2;

/// Middle of the end of the outline that touches something.
types::Vector2 touched_end(const types::BaseState& b, const types::Footprint& outline) {
  const bool behind = b.bumpers_rear != 0 && b.bumpers_front == 0;
  return {behind ? -outline.rear_m : outline.front_m, 0.0};
}

Touches counted(Touches before, const ControlSetup& setup, const ControlInput& in) {
  if (in.state == nullptr || !motion::is_finite(*in.state)) return before;
  const bool touching = is_touching(*in.state);
  if (before.touching || !touching) return {touching, before.count, before.at_odom};
  const types::Se2 T_odom_base = in.state->odometry.T_odom_base.se2();
  return {true, before.count + 1, T_odom_base * touched_end(*in.state, setup.limits.footprint)};
}

/// Ends the hold once a fresh plan stands, or has another goal.
Hold released(Hold hold, const Plan* plan, bool fresh) {
  if (fresh && hold.held && (!plan->moving || plan->goal_id != hold.goal)) hold.held = false;
  return hold;
}
Hold latched(Hold hold, const Plan* plan) {
  if (hold.held || plan == nullptr || !plan->moving) return hold;
  return {true, plan->goal_id};
}

/// The operator's twist. The rear has no sensor: backwards means back along the breadcrumb path.
Wish by_hand(const Teleop& teleop, const motion::GateInput& gate_in,
             const motion::BreadcrumbPath& breadcrumbs) {
  Wish wish{ControlMode::kTeleop, teleop.twist, true};
  if (!(teleop.twist.v_mps < 0.0)) return wish;
  const double speed_mps = std::min(-teleop.twist.v_mps, gate_in.limits.v_reverse_max_mps);
  const bool watched = gate_in.front_scan != nullptr && gate_in.base != nullptr;
  if (!watched || breadcrumbs.behind_m() <= speed_mps * motion::blind_time_s(gate_in)) return wish;
  const Twist2 back = breadcrumbs.back_twist(speed_mps);
  if (back == Twist2{}) return wish;
  wish.twist = back;
  wish.backing = motion::Backing::kAlongTrail;
  return wish;
}

/// A robot whose watchdog is being measured turns on the spot, by hand: it might go on when the host fails.
Wish on_trial(const Wish& wish, const types::RobotLimits& limits) {
  if (wish.mode != ControlMode::kTeleop) return {};
  Wish turn = wish;
  turn.twist = {0.0,
                std::clamp(wish.twist.omega_radps, -limits.omega_beside_radps, limits.omega_beside_radps)};
  turn.backing = motion::Backing::kNone;
  return turn;
}

bool is_by_hand(const ControlSetup& setup, const ControlInput& in) {
  return in.teleop != nullptr && in.teleop->stamp != Stamp{} &&
         in.now - in.teleop->stamp <= setup.limits.request_age_max;
}

void report_base(const ControlSetup& setup, const ControlInput& in, const motion::GateInput& gate_in,
                 const perception::UnseenEchoParams& params, ControlReport& report) {
  if (in.state == nullptr) return;
  const types::BaseState& base = *in.state;
  report.odometry = base.odometry;
  report.base_ready =
      !motion::is_stale(base.arrival, in.now, setup.limits.status_age_max) && motion::is_finite(base);
  report.battery_v = base.battery_v;
  report.state_of_charge = base.state_of_charge;
  report_unseen(gate_in, params, report);
}

}  // namespace

struct ControlState::Impl {
  Impl(const ControlParams& p, bool disobeyed)
      : params(p),
        plausibility(p.plausibility, disobeyed),
        senses(p.perception, p.motion),
        following(p.following, p.motion) {}

  ControlParams params;
  plausibility::Plausibility plausibility;
  ControlSenses senses;
  PlanFollowing following;
  motion::GateState gate;
  Granted last;
  Hold hold;
  Touches touches;
  Stamp wanted_at{};  ///< when motion was last requested; zero: never, or not since an e-stop
};

ControlState::ControlState(const ControlParams& params, bool disobeyed)
    : impl_(std::make_unique<Impl>(params, disobeyed)) {}
ControlState::~ControlState() = default;

ControlOutput control_step(ControlState& state, const ControlSetup& setup, const ControlInput& input) {
  ControlState::Impl& memory = *state.impl_;
  motion::GateInput gate_in = memory.senses.perceive(setup, input);
  gate_in.limits = limits_now(setup, input);
  const plausibility::Opinion opinion =
      memory.plausibility.judge(evidence(setup, input, gate_in.limits, memory.last));
  gate_in.doubts = opinion.doubts;
  gate_in.lag = opinion.lag;
  const Plan* plan = input.plan;
  const bool fresh = plan != nullptr && !motion::is_stale(plan->stamp, input.now, setup.plan_age_max);
  Hold hold = released(memory.hold, plan, fresh);
  const bool follows = fresh && plan->moving && (plan->points > 0 || plan->turn_to_rad) && !hold.held &&
                       !memory.gate.estop_latched;
  const bool hand = is_by_hand(setup, input);
  if (hand || !follows) memory.following.rest(input.now);
  Wish wish = hand      ? by_hand(*input.teleop, gate_in, memory.senses.breadcrumbs())
              : follows ? memory.following.follow(*plan, gate_in, memory.senses, memory.last)
                        : Wish{};
  if (input.watchdog_on_trial) wish = on_trial(wish, gate_in.limits);
  Stamp wanted_at = wish.moving ? input.now : memory.wanted_at;
  gate_in.request.twist = wish.twist;
  gate_in.backing = wish.backing;
  gate_in.by_hand = wish.mode == ControlMode::kTeleop;
  gate_in.request.enable_motors =
      wanted_at != Stamp{} && input.now - wanted_at <= memory.params.motors_linger;
  const motion::GateOutput out = motion::gate(memory.gate, gate_in);
  if (memory.gate.estop_latched) {  // the motors then need a new request
    wanted_at = {};
    hold = latched(hold, plan);
  }
  const bool motors = out.command.enable_motors && !out.command.silence;
  memory.last = {out.reason, wish.twist, memory.gate.last, motors};
  memory.hold = hold;
  memory.touches = counted(memory.touches, setup, input);
  memory.wanted_at = wanted_at;

  ControlOutput result;
  result.command = out.command;
  ControlReport& report = result.report;
  report.stamp = input.now;
  report.mode = wish.mode;
  report.goal_id = plan != nullptr ? plan->goal_id : 0;
  report.reason = out.reason;
  report.estop_latched = memory.gate.estop_latched;
  report.commanded = out.command.twist;
  report.free_distance_m = out.free_distance_m;
  report.plausibility = opinion;
  report.own_echo = memory.senses.own_echo().sector();
  report.recoveries = memory.following.recoveries();
  report.touches = memory.touches.count;
  report.touched_odom = memory.touches.at_odom;
  report_base(setup, input, gate_in, memory.params.perception.unseen_echoes, report);
  return result;
}

}  // namespace topo::pipeline
