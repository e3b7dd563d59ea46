// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/plausibility/obedience.hpp"

#include <algorithm>
#include <cmath>

namespace topo::plausibility {
namespace {

constexpr types::Duration kPast = Obedience::kLagStep * static_cast<int>(Obedience::kLags - 1);

bool is_outside(double speed, const SpeedBounds& bounds, double tolerance) {
  return speed > bounds.high + tolerance || speed < bounds.low - tolerance;
}

double wheel_mps(const types::Twist2& twist, double arm_m) { return twist.v_mps + arm_m * twist.omega_radps; }

/// Greatest change of the expected speed within the time that a lag may have.
double change_mps(const CommandHistory& commands, types::Stamp now, double arm_m) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (types::Stamp t = now - kPast; t <= now; t += Obedience::kLagStep) {
    const double speed = wheel_mps(commands.followed_at(t), arm_m);
    low = std::min(low, speed);
    high = std::max(high, speed);
  }
  return high - low;
}

}  // namespace

void Obedience::reset() { *this = Obedience(params_); }

void Obedience::measure_anew() {
  error_ = {};
  weight_ = 0.0;
  informative_ = 0;
}

/// A bound follows the command at once when it widens, and with the slowest believed braking when it narrows.
void Obedience::follow(SpeedBounds& bounds, double commanded, double braking, double elapsed_s) const {
  const double step = params_.braking_share * braking * elapsed_s;
  bounds.high = std::max({commanded, bounds.high - step, 0.0});
  bounds.low = std::min({commanded, bounds.low + step, 0.0});
}

bool Obedience::creeps(const types::Twist2& measured) {
  const bool to_stand = v_.high == 0.0 && v_.low == 0.0 && omega_.high == 0.0 && omega_.low == 0.0;
  const bool moves =
      std::abs(measured.v_mps) > params_.creep_mps || std::abs(measured.omega_radps) > params_.creep_radps;
  if (!to_stand || !moves || stood_ == types::Stamp{}) stood_ = last_;
  return last_ - stood_ > params_.creep_for;
}

bool Obedience::measure_lag(const CommandHistory& commands, const types::BaseState& state) {
  const types::Stamp now = state.odometry.stamp;
  // Motors that were just switched on begin late, and the commands before do not count.
  if (now - motors_on_ < kPast || change_mps(commands, now, params_.arm_m) < params_.informative_mps)
    return false;
  const double measured = wheel_mps(state.odometry.twist, params_.arm_m);
  for (std::size_t i = 0; i < kLags; ++i) {
    const double expected =
        wheel_mps(commands.followed_at(now - kLagStep * static_cast<int>(i)), params_.arm_m);
    error_[i] = params_.lag_forgetting * error_[i] + (measured - expected) * (measured - expected);
  }
  weight_ = params_.lag_forgetting * weight_ + 1.0;
  ++informative_;
  return true;
}

std::size_t Obedience::best_lag(std::size_t end) const {
  return static_cast<std::size_t>(
      std::min_element(error_.begin(), error_.begin() + static_cast<std::ptrdiff_t>(end)) - error_.begin());
}

ObedienceOpinion Obedience::judge(const CommandHistory& commands, const types::BaseState& state,
                                  const types::DriveLimits& limits) {
  const types::Stamp now = state.odometry.stamp;
  const double elapsed_s = last_ == types::Stamp{} ? 0.0 : std::max(types::to_seconds(now - last_), 0.0);
  last_ = now;
  // Any command within the admissible lag may be in force.
  const types::Duration longest = std::max(late_lag_, state.round_trip) + params_.lag_max;
  for (types::Duration lag{}; lag <= longest; lag += kLagStep) {
    const types::Twist2 commanded = commands.at(now - lag);
    const double step_s = lag == types::Duration{} ? elapsed_s : 0.0;
    follow(v_, commanded.v_mps, limits.deceleration_mps2, step_s);
    follow(omega_, commanded.omega_radps, limits.angular_acceleration_radps2, step_s);
  }
  ObedienceOpinion opinion;
  if (!state.motors_enabled) {
    outside_ = 0;
    motors_on_ = stood_ = now;
    return opinion;
  }
  const types::Twist2& measured = state.odometry.twist;
  const bool outside = is_outside(measured.v_mps, v_, params_.v_tolerance_mps) ||
                       is_outside(measured.omega_radps, omega_, params_.omega_tolerance_radps);
  outside_ = outside ? outside_ + 1 : 0;
  opinion.disobeys = creeps(measured) || outside_ >= params_.statuses;
  const bool informative = measure_lag(commands, state);
  opinion.lag = late_lag_;
  if (informative_ < params_.informative_statuses) return opinion;
  const auto admissible = static_cast<std::size_t>(params_.lag_max / kLagStep) + 1;
  const std::size_t best = best_lag(kLags), prompt = best_lag(std::min(admissible, kLags));
  const double prompt_error_mps = std::sqrt(error_[prompt] / weight_);
  opinion.late = informative && best > prompt && prompt_error_mps > params_.lag_error_mps &&
                 error_[best] <= params_.lag_gain * error_[prompt];
  const types::Duration lag = kLagStep * static_cast<int>(opinion.late ? best : prompt);
  if (opinion.late) late_lag_ = std::max(late_lag_, lag);
  opinion.lag = std::max(late_lag_, lag);
  return opinion;
}

}  // namespace topo::plausibility
