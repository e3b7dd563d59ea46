// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/drive.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "core/types/se2.hpp"

namespace topo::pioneer {
namespace {

using std::chrono::milliseconds;

constexpr types::Duration kCallerSilence = milliseconds(200);
constexpr types::Duration kUnheard = milliseconds(300);  // three cycles; the base thread's limit too
// A stop is not acknowledged: it is sent again until the robot stands.
constexpr types::Duration kStopAgain = milliseconds(200);
constexpr types::Duration kPulse = milliseconds(500);
constexpr types::Duration kSwitchAgain = milliseconds(500);
constexpr double kStands_mps = 0.005;
constexpr double kStands_radps = 0.01;

bool asks_for_motion(const types::BaseCommand& c) {
  return c.enable_motors || (!c.estop && (c.twist.v_mps != 0.0 || c.twist.omega_radps != 0.0));
}

/// What the firmware must be given, which reckons with the model's wheels, for the motion that is wanted.
types::Twist2 setpoint_of(const types::Twist2& wanted, const DriveLimits& limits) {
  const types::Progress p =
      types::counted_progress(limits.wheels, limits.model_track_m, {wanted.v_mps, wanted.omega_radps});
  return {p.way_m, p.turn_rad};
}

}  // namespace

Drive::Drive(Outbox& outbox, const DriveLimits& limits, bool sonar, bool may_move, types::Stamp now)
    : outbox_(outbox), limits_(limits), may_move_(may_move), last_heard_(now) {
  outbox_.set_velocity({});
  outbox_.push(encode(Command::kSetV, std::max(1, static_cast<int>(limits.v_mps * 1e3))));
  outbox_.push(encode(Command::kSetA, limits.acceleration_mmps2));
  outbox_.push(encode(Command::kSetA, -limits.deceleration_mmps2));
  outbox_.push(
      encode(Command::kSetRv, std::max(1, static_cast<int>(limits.omega_radps / types::kDegree_rad))));
  outbox_.push(encode(Command::kSetRa, limits.angular_acceleration_degps2));
  outbox_.push(encode(Command::kSetRa, -limits.angular_acceleration_degps2));
  outbox_.push(encode(Command::kSonar, sonar ? 1 : 0));
}

/// E_STOP a few times, then nothing: every packet feeds the watchdog of a base that obeys none.
void Drive::fall_silent() {
  silent_ = true;
  want_motors_ = false;
  outbox_.clear();
  if (last_words_ > 0) outbox_.set_estop();
  last_words_ = std::max(last_words_ - 1, 0);
}

types::Status Drive::command(const types::BaseCommand& command, types::Stamp now) {
  last_command_ = now;
  commanded_ = ever_commanded_ = true;
  stopping_ = false;
  if (command.silence) {
    fall_silent();
    return {};
  }
  if (std::exchange(silent_, false)) {  // a base that is heard again resumes its last setpoint
    last_words_ = kLastWords;
    outbox_.set_estop();
    return {};
  }
  const bool refused = !may_move_ && asks_for_motion(command);
  if (!command.enable_motors) enable_blocked_ = false;
  want_motors_ = may_move_ && command.enable_motors && !enable_blocked_;
  Setpoints setpoints = want_motors_ && !command.estop ? quantise(setpoint_of(command.twist, limits_),
                                                                  limits_.v_mps, limits_.omega_radps)
                                                       : Setpoints{};
  if (on_trial() && setpoints.v_mmps != 0) setpoints = {};
  asked_ = setpoints != Setpoints{};
  if (trial_ && trial_->withholds(setpoints, command.estop, now)) return {};
  // On a line that loses bytes RVEL 0 may arrive without VEL 0, and then feeds the watchdog of a robot that
  // drives on: a robot without status is stopped by E_STOP, which needs no second packet.
  const bool stop_unheard = !asked_ && !stands_ && now - last_heard_ > kUnheard;
  if (command.estop || stop_unheard) outbox_.set_estop();
  // VEL 0 after E_STOP could soften the braking, so it waits until the robot stands; then it makes sure that
  // no setpoint remains to be resumed.
  if (stands_ || !(command.estop || stop_unheard)) outbox_.set_velocity(setpoints);
  if (refused) return types::fail(types::Errc::kUnsupported, "unsafe: refused");  // short: no allocation
  return {};
}

void Drive::on_state(const types::BaseState& state, types::Stamp now) {
  last_heard_ = now;
  const types::Twist2& twist = state.odometry.twist;
  stands_ = std::abs(twist.v_mps) < kStands_mps && std::abs(twist.omega_radps) < kStands_radps;
  if (state.stop_button) enable_blocked_ = true;
  if (enable_blocked_) want_motors_ = false;
  if (on_trial()) {
    trial_->on_state(state, now);
    // The firmware resumes its last setpoint with the next packet; the caller's next command decides.
    if (trial_->result() == WatchdogTrial::Result::kPassed) outbox_.set_estop();
    end_trial_if_due(now);
  }
  switch_motors(state, now);
}

/// There is no acknowledgement: ENABLE is repeated until the status confirms it. Motors are switched off only
/// at a standstill, because a robot without motors does not brake.
void Drive::switch_motors(const types::BaseState& state, types::Stamp now) {
  if (silent_ || !ever_commanded_ || state.motors_enabled == want_motors_ || state.stop_button) return;
  if (!want_motors_ && !stands_) return;
  if (last_switch_ != types::Stamp{} && now - last_switch_ < kSwitchAgain) return;
  last_switch_ = now;
  outbox_.push(encode(Command::kEnable, want_motors_ ? 1 : 0));
}

void Drive::end_trial_if_due(types::Stamp now) {
  if (!trial_->must_stop(now)) return;
  outbox_.set_estop();
  stopping_ = true;
  last_stop_ = now;
  if (trial_->result() == WatchdogTrial::Result::kFailed) may_move_ = want_motors_ = false;
}

void Drive::stop(types::Stamp now) {
  last_stop_ = now;
  outbox_.set_velocity({});
}

void Drive::keep_alive(types::Stamp now, types::Stamp last_send) {
  if (silent_) return;
  if (trial_ && trial_->silent()) {
    const bool called = now - last_command_ < kCallerSilence;
    if (called) end_trial_if_due(now);
    if (!called) std::ignore = trial_->withholds({}, false, now);  // the stop below ends the silence
    if (trial_->silent()) return;
  }
  if (commanded_ && now - last_command_ >= kCallerSilence) {
    commanded_ = false;
    stopping_ = true;
    stop(now);
  }
  if (stopping_ && now - last_stop_ >= kStopAgain) {
    stop(now);
    stopping_ = !stands_;
  }
  if (outbox_.empty() && now - last_send >= kPulse) outbox_.push(encode(Command::kPulse));
}

types::Stamp Drive::next_due(types::Stamp last_send) const {
  if (silent_) return types::Stamp::max();
  if (trial_ && trial_->silent()) return std::min(trial_->deadline(), last_command_ + kCallerSilence);
  types::Stamp due = last_send + kPulse;
  if (commanded_) due = std::min(due, last_command_ + kCallerSilence);
  if (stopping_) due = std::min(due, last_stop_ + kStopAgain);
  return due;
}

}  // namespace topo::pioneer
