// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/control_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/motion/breadcrumb_path.hpp"
#include "core/motion/path_follower.hpp"
#include "core/motion/recovery.hpp"
#include "core/motion/yielding.hpp"
#include "core/perception/blind_spot.hpp"
#include "core/perception/moving_obstacles.hpp"
#include "core/perception/steady_frame.hpp"
#include "core/perception/stop_zone.hpp"
#include "core/perception/unseen_echoes.hpp"

namespace topo::pipeline {
namespace {

using motion::GateReason;
using motion::RecoveryPhase;
using types::Se2;
using types::Twist2;

constexpr double kObstacleReach_m = 2.8;  // more than the way that 0.7 m/s needs free
constexpr double kObstacleSpacing_m = 0.03;
constexpr types::Duration kMotorsLinger = std::chrono::seconds(10);  // wished for no longer: off
constexpr double kSameGoal_m = 0.2;
const motion::BreadcrumbPath kNoTrail;

/// What the period wants, before the gate.
struct Wish {
  ControlMode mode = ControlMode::kStanding;
  Twist2 twist;
  bool moving = false;  ///< somebody wants the robot to move: motors on
  motion::Backing backing = motion::Backing::kNone;
};

bool is_fresh(types::Stamp stamp, types::Stamp now, types::Duration age_max) {
  return !motion::is_stale(stamp, now, age_max);
}

/// Reasons that have to do with the place and not with the state of the robot.
bool is_in_the_way(GateReason reason) {
  return reason == GateReason::kBlocked || reason == GateReason::kAreaLimit;
}

/// Does something that moves hold up a robot that finds no way, or only it?
bool is_held_up(bool blocked, GateReason last, std::span<const perception::MovingObstacle> moving) {
  constexpr double kBeside_m = 1.5;
  if (last == GateReason::kGivesWay) return true;
  return (blocked || is_in_the_way(last)) && !moving.empty() && moving.front().centre.norm() < kBeside_m;
}

bool is_touch(GateReason reason) { return reason == GateReason::kStall || reason == GateReason::kBumper; }

bool lets_move(GateReason reason) {
  return reason == GateReason::kFree || reason == GateReason::kLimited || reason == GateReason::kSlowed;
}

/// A turn that gets ever slower towards a corner takes its time and leads nowhere.
bool lets_nothing_through(GateReason reason, const Twist2& wished, const Twist2& given) {
  constexpr double kTurns_radps = 0.3, kHardly_radps = 0.08;
  const bool turns = wished.v_mps == 0.0 && std::abs(wished.omega_radps) > kTurns_radps;
  return !lets_move(reason) || (turns && std::abs(given.omega_radps) < kHardly_radps);
}

bool is_touching(const types::BaseState& b) {
  return b.bumpers_front != 0 || b.bumpers_rear != 0 || b.stall_left || b.stall_right;
}

/// The middle of the outline's end that touches.
types::Vector2 touched_end(const types::BaseState& b, const types::Footprint& outline) {
  const bool behind = b.bumpers_rear != 0 && b.bumpers_front == 0;
  return {behind ? -outline.rear_m : outline.front_m, 0.0};
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

}  // namespace

struct ControlState::Impl {
  motion::GateState gate;
  GateReason last_reason = GateReason::kFree;
  Twist2 wished;  ///< in the last period
  motion::PathFollower follower;
  motion::Recovery recovery;
  perception::SteadyFrame steady_frame;  ///< of the trail and of the blind spot
  std::uint64_t steady_plan = 0;         ///< the last one that it was told of
  motion::BreadcrumbPath trail;
  types::Stamp trail_stamp{};
  types::Stamp wanted_at{};  ///< when somebody last wanted to move; zero: never, or an e-stop since
  bool held = false;         ///< after an e-stop: until the plan stood, or is about another goal
  std::uint64_t held_goal = 0;
  bool recovering = false;  ///< the last period's motion was the recovery's
  std::uint64_t arrived_goal = 0;
  types::Vector2 arrived_at{0.0, 0.0};
  bool arrived = false;
  bool touching = false;  ///< in the last period
  std::uint32_t touches = 0;
  types::Vector2 touched_odom{0.0, 0.0};
  std::array<types::Vector2, motion::PathFollower::kMaxObstacles> obstacles{};
  /// What the scanner saw before, and from kMax on what it sees.
  std::array<perception::ScanPoint, perception::BlindSpot::kMax + types::Scan::kMaxBeams> points{};
  perception::BlindSpot blind_spot;
  perception::MovingObstacles tracker;
  std::array<perception::MovingObstacle, perception::MovingObstacles::kMax> moving{};
  motion::Yielding yielding;

  [[nodiscard]] motion::GateInput gate_input(const ControlSetup& setup, const ControlInput& in);
  [[nodiscard]] std::optional<Se2> place(const ControlSetup& setup, const ControlInput& in) const;
  [[nodiscard]] std::span<const perception::MovingObstacle> look_for_movers(const ControlSetup& setup,
                                                                            const ControlInput& in);
  [[nodiscard]] std::span<const perception::ScanPoint> look_around(
      const ControlSetup& setup, const ControlInput& in,
      std::span<const perception::MovingObstacle> moving_now);
  void follow_drift(const ControlSetup& setup, const ControlInput& in);
  void drive_on(const ControlInput& in);
  void count_touches(const ControlSetup& setup, const ControlInput& in);
  [[nodiscard]] bool may_follow(const ControlSetup& setup, const ControlInput& in);
  [[nodiscard]] Wish wish(const ControlSetup& setup, const ControlInput& in,
                          const motion::GateInput& gate_in);
  [[nodiscard]] Wish follow(const ControlInput& in, const motion::GateInput& gate_in);
  [[nodiscard]] Wish teleop(const Teleop& teleop, const motion::GateInput& gate_in) const;
  [[nodiscard]] motion::FollowOutput way(const Plan& plan, const Se2& T_odom_base,
                                         const motion::GateInput& gate_in);
  [[nodiscard]] double ahead_m(const motion::GateInput& gate_in) const;
  [[nodiscard]] double seen_behind_m(const Plan& plan, const motion::GateInput& gate_in) const;
  [[nodiscard]] bool is_arrived(const Plan& plan);
  void latch(const ControlInput& in);
};

/// Puts what only sonar noticed into the report.
void report_unseen(const motion::GateInput& gate_in, ControlReport& report) {
  constexpr double kRange_m = 1.2;
  constexpr double kSteady_radps =
      0.3;  // an echo is up to 150 ms old: turning faster, it is of another direction
  if (std::abs(gate_in.base->odometry.twist.omega_radps) > kSteady_radps) return;
  const std::size_t count =
      perception::unseen_echoes(motion::surroundings(gate_in), kRange_m, report.unseen_odom);
  for (std::size_t i = 0; i < count; ++i)
    report.unseen_odom[i] = report.odometry.T_odom_base.se2() * report.unseen_odom[i];
  report.unseen = static_cast<std::uint8_t>(count);
}

ControlState::ControlState() : impl_(std::make_unique<Impl>()) {}
ControlState::~ControlState() = default;

motion::GateInput ControlState::Impl::gate_input(const ControlSetup& setup, const ControlInput& in) {
  motion::GateInput g;
  g.now = in.now;
  g.request.stamp = in.now;
  g.base = in.state;
  g.front_scan = in.front;
  g.T_base_laser = setup.T_base_laser;
  g.moving = look_for_movers(setup, in);
  g.front_points = look_around(setup, in, g.moving);
  g.T_base_sonar = in.T_base_sonar;
  g.estop_pressed = in.estop;
  g.estop_cleared = in.estop_cleared;
  g.firmware_watchdog = in.firmware_watchdog;
  g.limits = setup.limits;
  g.area = &setup.area;
  g.T_map_base = place(setup, in);
  return g;
}

/// Where the robot is in map, if somebody knows: by the newest plan, which has to be fresh, and made by a
/// planner that knew the place. A plan to stand is fresh as well when nobody does.
std::optional<Se2> ControlState::Impl::place(const ControlSetup& setup, const ControlInput& in) const {
  if (in.plan == nullptr || !in.plan->located || in.state == nullptr) return std::nullopt;
  if (!is_fresh(in.plan->stamp, in.now, setup.plan_age_max)) return std::nullopt;
  return in.plan->T_map_odom.se2() * perception::pose_at(in.state->odometry, in.now);
}

std::span<const perception::MovingObstacle> ControlState::Impl::look_for_movers(const ControlSetup& setup,
                                                                                const ControlInput& in) {
  if (in.front == nullptr || in.state == nullptr || !motion::is_finite(*in.state)) return {};
  tracker.update(*in.front, setup.T_base_laser, in.state->odometry);
  return {moving.data(), tracker.around(in.state->odometry, in.front->first_beam, moving)};
}

std::span<const perception::ScanPoint> ControlState::Impl::look_around(
    const ControlSetup& setup, const ControlInput& in,
    std::span<const perception::MovingObstacle> moving_now) {
  if (in.front == nullptr) return {};
  constexpr std::size_t kSeen = perception::BlindSpot::kMax;
  const std::span<perception::ScanPoint> all(points);
  const std::size_t seen = perception::scan_points(*in.front, setup.T_base_laser, all.subspan(kSeen));
  if (in.state == nullptr || !motion::is_finite(*in.state)) return all.subspan(kSeen, seen);
  const types::Odometry odometry = steady_frame.steady(in.state->odometry);
  blind_spot.update(*in.front, setup.T_base_laser, all.subspan(kSeen, seen), moving_now,
                    setup.limits.footprint, odometry);
  const std::size_t kept = blind_spot.size();
  blind_spot.put_points(perception::pose_at(odometry, in.front->first_beam), all.subspan(kSeen - kept, kept));
  return all.subspan(kSeen - kept, kept + seen);
}

/// Once for every plan.
void ControlState::Impl::follow_drift(const ControlSetup& setup, const ControlInput& in) {
  if (in.state == nullptr || !motion::is_finite(*in.state)) return;
  if (!place(setup, in)) return steady_frame.lose();
  if (in.plan->sequence == std::exchange(steady_plan, in.plan->sequence)) return;
  steady_frame.update(in.plan->T_map_odom, in.plan->bends, in.state->odometry);
}

/// The trail takes every reckoning once.
void ControlState::Impl::drive_on(const ControlInput& in) {
  if (in.state == nullptr || in.state->odometry.stamp == trail_stamp || !motion::is_finite(*in.state)) return;
  trail_stamp = in.state->odometry.stamp;
  trail.update(steady_frame.steady(in.state->odometry).T_odom_base.se2());
}

void ControlState::Impl::count_touches(const ControlSetup& setup, const ControlInput& in) {
  if (in.state == nullptr || !motion::is_finite(*in.state)) return;
  const bool before = std::exchange(touching, is_touching(*in.state));
  if (before || !touching) return;
  ++touches;
  touched_odom = in.state->odometry.T_odom_base.se2() * touched_end(*in.state, setup.limits.footprint);
}

/// After an e-stop the plan has to have stood, or to be about another goal, before it may move the robot.
bool ControlState::Impl::may_follow(const ControlSetup& setup, const ControlInput& in) {
  if (in.plan == nullptr || !is_fresh(in.plan->stamp, in.now, setup.plan_age_max)) return false;
  if (held && (!in.plan->moving || in.plan->goal_id != held_goal)) held = false;
  return in.plan->moving && in.plan->points > 0 && !held && !gate.estop_latched;
}

Wish ControlState::Impl::teleop(const Teleop& teleop, const motion::GateInput& gate_in) const {
  Wish wish{ControlMode::kTeleop, teleop.twist, true};
  if (!(teleop.twist.v_mps < 0.0)) return wish;
  // The rear is blind: backwards means back along the way it came.
  const double speed_mps = std::min(-teleop.twist.v_mps, gate_in.limits.v_reverse_max_mps);
  const bool watched = gate_in.front_scan != nullptr && gate_in.base != nullptr;
  if (!watched || trail.behind_m() <= speed_mps * motion::blind_time_s(gate_in)) return wish;
  const Twist2 back = trail.back_twist(speed_mps);
  if (back == Twist2{}) return wish;
  wish.twist = back;
  wish.backing = motion::Backing::kAlongTrail;
  return wish;
}

motion::FollowOutput ControlState::Impl::way(const Plan& plan, const Se2& T_odom_base,
                                             const motion::GateInput& gate_in) {
  const std::size_t count = perception::collect_obstacles(gate_in.limits, motion::surroundings(gate_in),
                                                          kObstacleReach_m, kObstacleSpacing_m, obstacles);
  motion::FollowInput f;
  f.T_odom_base = T_odom_base;
  f.twist = gate.last;
  f.path_odom = {plan.path_odom.data(), std::min<std::size_t>(plan.points, Plan::kMaxPoints)};
  f.path_number = plan.sequence;
  f.ends_at_goal = plan.path_ends_at_goal;
  f.obstacles_base = {obstacles.data(), count};
  f.blind_s = motion::blind_time_s(gate_in);
  f.alive_s = motion::alive_time_s(gate_in);
  types::RobotLimits limits = gate_in.limits;
  limits.v_max_mps = std::min(limits.v_max_mps, plan.v_max_mps);
  f.limits = &limits;
  return follower.step(f);
}

/// What of the surroundings only a robot that recovers asks for: the way free straight on, ...
double ControlState::Impl::ahead_m(const motion::GateInput& gate_in) const {
  if (!recovering) return 0.0;
  const Twist2 on{gate_in.limits.v_reverse_max_mps, 0.0};
  return perception::free_distance_m(
      on, perception::free_time_s(on, gate_in.limits, motion::surroundings(gate_in)));
}

/// ... and straight back.
double ControlState::Impl::seen_behind_m(const Plan& plan, const motion::GateInput& gate_in) const {
  if (!recovering || plan.mate_behind) return 0.0;
  const Se2 T_odom_base = perception::pose_at(steady_frame.steady(gate_in.base->odometry), gate_in.now);
  return blind_spot.seen_behind_m(T_odom_base, gate_in.limits.footprint, gate_in.now,
                                  motion::Recovery::kSeenBehind_m);
}

bool ControlState::Impl::is_arrived(const Plan& plan) {
  const std::size_t last = std::min<std::size_t>(plan.points, Plan::kMaxPoints) - 1;
  arrived = arrived && arrived_goal == plan.goal_id && plan.path_ends_at_goal &&
            (plan.path_odom[last] - arrived_at).norm() < kSameGoal_m;
  return arrived;
}

Wish ControlState::Impl::follow(const ControlInput& in, const motion::GateInput& gate_in) {
  const Plan& plan = *in.plan;
  Wish wish{ControlMode::kFollowing, {}, true};
  if (is_arrived(plan)) {
    recovery.pause(in.now);
    wish.mode = ControlMode::kArrived;
    wish.moving = false;
    return wish;
  }
  const bool able = gate_in.base != nullptr && gate_in.front_scan != nullptr &&
                    motion::is_finite(*gate_in.base) &&
                    (lets_move(last_reason) || is_in_the_way(last_reason) || is_touch(last_reason) ||
                     last_reason == GateReason::kGivesWay);
  if (!able) {  // the gate says why; it is nobody's fault that the robot does not get on
    recovery.pause(in.now);
    return wish;
  }
  const Se2 T_odom_base = perception::pose_at(gate_in.base->odometry, in.now);
  const motion::FollowOutput out = way(plan, T_odom_base, gate_in);
  yielding.update(in.now, is_held_up(out.blocked, last_reason, gate_in.moving), gate_in.moving);
  if (!recovering && !out.arrived && (yielding.waits() || yielding.lets_go_first())) {
    recovery.pause(in.now);
    wish.mode = ControlMode::kWaiting;
    if (yielding.waits()) wish.twist = out.twist;
    return wish;
  }
  motion::RecoveryInput r;
  r.now = in.now;
  r.goal_id = plan.goal_id;
  r.T_odom_base = T_odom_base;
  r.blocked = out.blocked || (!recovering && is_in_the_way(last_reason));
  r.touching = is_touching(*gate_in.base);
  r.refused = recovering && lets_nothing_through(last_reason, wished, gate.last);
  r.turn_rad = out.turn_rad;
  r.blind_s = motion::blind_time_s(gate_in);
  r.ahead_m = ahead_m(gate_in);
  r.seen_behind_m = seen_behind_m(plan, gate_in);
  r.trail = plan.mate_behind ? &kNoTrail : &trail;
  r.limits = &gate_in.limits;
  const motion::RecoveryOutput rescue = recovery.step(r);
  wish.mode = mode_of(rescue.phase);
  recovering = wish.mode == ControlMode::kRecovering;
  const bool may_go = rescue.phase == RecoveryPhase::kNone || rescue.phase == RecoveryPhase::kWaiting;
  wish.twist = may_go ? out.twist : rescue.twist;
  wish.backing = rescue.backing;
  if (may_go && out.arrived) {
    arrived = true;
    arrived_goal = plan.goal_id;
    arrived_at = plan.path_odom[std::min<std::size_t>(plan.points, Plan::kMaxPoints) - 1];
    wish.mode = ControlMode::kArrived;
  }
  return wish;
}

Wish ControlState::Impl::wish(const ControlSetup& setup, const ControlInput& in,
                              const motion::GateInput& gate_in) {
  const bool follows = may_follow(setup, in);
  const bool by_hand = in.teleop != nullptr && in.teleop->stamp != types::Stamp{} &&
                       in.now - in.teleop->stamp <= setup.limits.request_age_max;
  if (by_hand || !follows) {
    follower.reset();
    recovery.pause(in.now);
    recovering = false;
  }
  if (by_hand) return teleop(*in.teleop, gate_in);
  return follows ? follow(in, gate_in) : Wish{};
}

/// After an e-stop the operator has to ask anew before the motors are enabled again.
void ControlState::Impl::latch(const ControlInput& in) {
  if (!gate.estop_latched) return;
  wanted_at = types::Stamp{};
  if (held || in.plan == nullptr || !in.plan->moving) return;
  held = true;
  held_goal = in.plan->goal_id;
}

ControlOutput control_step(ControlState& state, const ControlSetup& setup, const ControlInput& input) {
  ControlState::Impl& memory = *state.impl_;
  memory.follow_drift(setup, input);
  memory.drive_on(input);
  memory.count_touches(setup, input);
  motion::GateInput gate_in = memory.gate_input(setup, input);
  const Wish wish = memory.wish(setup, input, gate_in);
  if (wish.moving) memory.wanted_at = input.now;
  gate_in.request.twist = wish.twist;
  gate_in.backing = wish.backing;
  gate_in.by_hand = wish.mode == ControlMode::kTeleop;
  gate_in.request.enable_motors =
      memory.wanted_at != types::Stamp{} && input.now - memory.wanted_at <= kMotorsLinger;
  const motion::GateOutput out = motion::gate(memory.gate, gate_in);
  memory.last_reason = out.reason;
  memory.wished = wish.twist;
  memory.latch(input);

  ControlOutput result;
  result.command = out.command;
  ControlReport& report = result.report;
  report.stamp = input.now;
  report.mode = wish.mode;
  report.goal_id = input.plan != nullptr ? input.plan->goal_id : 0;
  report.reason = out.reason;
  report.estop_latched = memory.gate.estop_latched;
  report.commanded = out.command.twist;
  report.free_distance_m = out.free_distance_m;
  report.recoveries = memory.recovery.begun();
  report.touches = memory.touches;
  report.touched_odom = memory.touched_odom;
  if (input.state != nullptr) {
    const types::BaseState& base = *input.state;
    report.odometry = base.odometry;
    report.base_ready =
        is_fresh(base.arrival, input.now, setup.limits.status_age_max) && motion::is_finite(base);
    report.battery_v = base.battery_v;
    report.state_of_charge = base.state_of_charge;
    report_unseen(gate_in, report);
  }
  return result;
}

std::string_view to_text(ControlMode mode) {
  switch (mode) {
    case ControlMode::kStanding:
      return "standing";
    case ControlMode::kTeleop:
      return "driven by hand";
    case ControlMode::kFollowing:
      return "following";
    case ControlMode::kArrived:
      return "arrived";
    case ControlMode::kWaiting:
      return "waiting";
    case ControlMode::kRecovering:
      return "recovering";
    case ControlMode::kStuck:
      return "stuck";
  }
  return "unknown";
}

}  // namespace topo::pipeline
