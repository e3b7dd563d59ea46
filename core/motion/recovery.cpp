// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/motion/recovery.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace topo::motion {
namespace {

using types::Stamp;

Stamp since(bool is, Stamp before, Stamp now) {
  if (!is) return Stamp{};
  return before == Stamp{} ? now : before;
}

bool lasts(Stamp from, Stamp now, types::Duration time) { return from != Stamp{} && now - from >= time; }

/// The same heading, reached by turning left (`sense` 1), right (-1), or by the shorter turn (0).
double turned(double angle_rad, int sense) {
  constexpr double kRound_rad = 2.0 * std::numbers::pi;
  if (sense == 0 || angle_rad * sense >= 0.0) return angle_rad;
  return angle_rad + sense * kRound_rad;
}

types::Twist2 turn_twist(double angle_rad, const types::RobotLimits& limits, double omega_max_radps) {
  const double fastest = std::min(omega_max_radps, limits.omega_max_radps);
  const double rate = std::sqrt(limits.angular_acceleration_radps2 * std::abs(angle_rad));
  return {0.0, std::copysign(std::min(fastest, rate), angle_rad)};
}

}  // namespace

void Recovery::enter(RecoveryPhase phase, const RecoveryInput& in) {
  phase_ = phase;
  since_ = in.now;
  blocked_ = refused_ = Stamp{};
  sense_ = 0;
  backs_askew_ = false;
  progress_ = in.now;
  progress_at_ = phase_at_ = in.T_odom_base.translation();
}

void Recovery::begin(const RecoveryInput& in) {
  if (tries_ >= rules_.tries) {
    enter(RecoveryPhase::kStuck, in);
    return;
  }
  if (tries_ == 0) first_at_ = in.T_odom_base.translation();
  ++tries_;
  ++begun_;
  tried_ = in.now;
  eased_m_.reset();
  enter(RecoveryPhase::kBacking, in);
}

void Recovery::pause(Stamp now) {
  if (phase_ == RecoveryPhase::kWaiting) phase_ = RecoveryPhase::kNone;
  progress_ = since_ = now;
  blocked_ = refused_ = Stamp{};
}

void Recovery::note_progress(const RecoveryInput& in) {
  const types::Vector2 at = in.T_odom_base.translation();
  if (tries_ > 0 && !((at - first_at_).norm() < rules_.forgotten_m)) tries_ = 0;
  if (progress_ != Stamp{} && (at - progress_at_).norm() < rules_.progress_m) return;
  progress_ = in.now;
  progress_at_ = at;
}

void Recovery::watch(const RecoveryInput& in) {
  blocked_ = since(in.blocked || in.touching, blocked_, in.now);
  note_progress(in);
  const bool hopeless = in.touching && lasts(blocked_, in.now, rules_.blink);
  if (hopeless || lasts(progress_, in.now, rules_.no_progress) || lasts(blocked_, in.now, rules_.wait))
    begin(in);
  else
    phase_ = lasts(blocked_, in.now, rules_.blink) ? RecoveryPhase::kWaiting : RecoveryPhase::kNone;
}

types::Twist2 Recovery::back_twist(const RecoveryInput& in) const {
  const double backed_m = (in.T_odom_base.translation() - phase_at_).norm();
  if (backed_m >= rules_.back.most_m) return {};
  // If the host fails, the robot rolls on until the watchdog fires, and must still be on the breadcrumb path.
  // Near the path's end it creeps: two more centimetres may give it the clearance to turn.
  const double most_mps = in.blind_s > 0.0 ? in.trail->behind_m() / in.blind_s : HUGE_VAL;
  if (most_mps <= rules_.back.creep_mps) return {};
  return in.trail->back_twist(std::min(most_mps, in.limits->v_reverse_max_mps));
}

/// The shorter turn may lack clearance when the other one, by which the robot arrived, does not.
void Recovery::turn_other_way_when_refused(double angle_rad, const RecoveryInput& in) {
  if (sense_ != 0 || !lasts(refused_, in.now, rules_.refused)) return;
  sense_ = angle_rad > 0.0 ? -1 : 1;
  refused_ = Stamp{};
}

RecoveryOutput Recovery::back(const RecoveryInput& in) {
  const double backed_m = (in.T_odom_base.translation() - phase_at_).norm();
  const BackingParams& p = rules_.back;
  refused_ = since(in.refused, refused_, in.now);
  // Each try backs off farther than the last: the path ahead looks different from farther away.
  const double enough_m = std::min(p.enough_m * tries_, p.most_m - p.slack_m);
  const bool clear = !in.blocked && !in.touching && backed_m >= enough_m;
  if (clear) {
    enter(RecoveryPhase::kNone, in);
    return {};
  }
  const double aside_rad = in.trail->turn_to_back_rad();
  // The robot has turned since: it first turns the breadcrumb path behind itself, or the tail would sweep
  // ground that it never covered.
  bool aside = !in.touching && !backs_askew_ && backed_m < p.begun_m &&
               std::abs(aside_rad) > p.straight_rad &&
               in.trail->length_m() > p.enough_m + in.limits->v_reverse_max_mps * in.blind_s;
  if (aside && std::abs(aside_rad) <= in.trail->params().behind_rad &&
      lasts(refused_, in.now, rules_.refused)) {
    // No clearance even for this small turn, as in a doorway: back off at the current heading, as far as the
    // gate allows.
    backs_askew_ = true;
    aside = false;
    refused_ = Stamp{};
  }
  if (aside) turn_other_way_when_refused(aside_rad, in);
  const bool over = lasts(since_, in.now, rules_.phase_max) || lasts(refused_, in.now, rules_.refused);
  if (!over && aside)
    return {phase_, turn_twist(turned(aside_rad, sense_), *in.limits, rules_.omega_max_radps)};
  const types::Twist2 twist = over ? types::Twist2{} : back_twist(in);
  if (twist != types::Twist2{}) return {phase_, twist, Backing::kAlongTrail};
  backed_m_ = backed_m;
  enter(RecoveryPhase::kTurning, in);
  return turn(in);
}

RecoveryOutput Recovery::turn(const RecoveryInput& in) {
  refused_ = since(in.refused, refused_, in.now);
  turn_other_way_when_refused(in.turn_rad, in);
  const bool over = lasts(since_, in.now, rules_.phase_max) || lasts(refused_, in.now, rules_.refused);
  const bool aligned = std::abs(in.turn_rad) < rules_.aligned_rad;
  if (over && !aligned && !in.touching && backed_m_ < rules_.back.enough_m) {
    // The first try drives straight ahead where there is free space, because the scanner observes it. The
    // later tries ease back first, and drive straight ahead when that fails.
    const bool on_first = tries_ == 1 && !eased_m_ && in.ahead_m >= rules_.room_ahead_m;
    if (!on_first && !eased_m_) {
      enter(RecoveryPhase::kEasing, in);
      return ease(in);
    }
    if (on_first || *eased_m_ < rules_.ease.step_m * tries_) {
      enter(RecoveryPhase::kLeaving, in);
      return leave(in);
    }
  }
  if (over || aligned) {
    enter(RecoveryPhase::kNone, in);
    return {};
  }
  return {phase_, turn_twist(turned(in.turn_rad, sense_), *in.limits, rules_.omega_max_radps)};
}

/// A jamb between the front corners, nearer than the turning circle, holds a robot with free space behind it;
/// wheel slip in a turn can bring it that near. The distance grows with each try.
RecoveryOutput Recovery::ease(const RecoveryInput& in) {
  refused_ = since(in.refused, refused_, in.now);
  const double eased_m = (in.T_odom_base.translation() - phase_at_).norm();
  // If the host fails, the robot rolls on until the watchdog fires, and must still be over seen ground.
  const double most_mps = in.blind_s > 0.0 ? in.seen_behind_m / in.blind_s : HUGE_VAL;
  const bool over = lasts(since_, in.now, rules_.phase_max) || lasts(refused_, in.now, rules_.refused);
  if (over || eased_m >= rules_.ease.step_m * tries_ || in.touching || most_mps < rules_.ease.least_mps) {
    eased_m_ = eased_m;
    enter(RecoveryPhase::kTurning, in);
    return turn(in);
  }
  return {phase_, {-std::min(most_mps, rules_.ease.speed_mps), 0.0}, Backing::kOverSeenGround};
}

RecoveryOutput Recovery::leave(const RecoveryInput& in) {
  refused_ = since(in.refused, refused_, in.now);
  const double left_m = (in.T_odom_base.translation() - phase_at_).norm();
  if (in.touching || left_m >= rules_.leave_m || lasts(refused_, in.now, rules_.refused) ||
      lasts(tried_, in.now, rules_.try_max)) {
    enter(RecoveryPhase::kNone, in);
    return {};
  }
  return {phase_, {in.limits->v_reverse_max_mps, 0.0}};
}

RecoveryOutput Recovery::step(const RecoveryInput& in) {
  if (in.goal_id != goal_id_) {
    goal_id_ = in.goal_id;
    tries_ = 0;
    enter(RecoveryPhase::kNone, in);
  }
  switch (phase_) {
    case RecoveryPhase::kStuck:
      return {phase_, {}};
    case RecoveryPhase::kBacking:
      return back(in);
    case RecoveryPhase::kEasing:
      return ease(in);
    case RecoveryPhase::kTurning:
      return turn(in);
    case RecoveryPhase::kLeaving:
      return leave(in);
    case RecoveryPhase::kNone:
    case RecoveryPhase::kWaiting:
      watch(in);
      return {phase_, {}};
  }
  return {};
}

}  // namespace topo::motion
