// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/watchdog_trial.hpp"

#include <cmath>
#include <utility>

namespace topo::pioneer {

bool WatchdogTrial::withholds(const Setpoints& setpoints, bool estop, types::Stamp now) {
  if (result_ != Result::kPending) return false;
  const bool same = setpoints == last_ && setpoints.omega_degps != 0 && setpoints.v_mmps == 0 && !estop;
  if (!same) {  // also a stop: it is sent, and the trial begins anew with the next turn
    silent_since_ = turning_since_ = {};
  } else if (!silent() && turning_since_ != types::Stamp{} && now - turning_since_ >= params_.steady) {
    silent_since_ = last_sent_;
  }
  last_ = setpoints;
  if (!silent()) last_sent_ = now;
  return silent();
}

void WatchdogTrial::on_state(const types::BaseState& state, types::Stamp now) {
  heard_ = now;
  const double turn_radps = std::abs(state.odometry.twist.omega_radps);
  const bool hindered = state.stop_button || state.stall_left || state.stall_right || !state.motors_enabled ||
                        state.bumpers_front != 0 || state.bumpers_rear != 0;
  if (hindered) {  // wheels that stand now say nothing of the watchdog
    silent_since_ = turning_since_ = {};
    return;
  }
  if (turn_radps < params_.turning_radps / 2.0) {
    turning_since_ = {};
    if (!silent()) return;
    measured_ = now - std::exchange(silent_since_, types::Stamp{});
    result_ = Result::kPassed;
  } else if (turn_radps >= params_.turning_radps && turning_since_ == types::Stamp{}) {
    turning_since_ = now;
  }
}

bool WatchdogTrial::must_stop(types::Stamp now) {
  if (!silent()) return false;
  const bool too_long = now >= deadline();
  if (!too_long && now - heard_ <= params_.unheard) return false;
  if (too_long) result_ = Result::kFailed;
  silent_since_ = turning_since_ = {};
  return true;
}

}  // namespace topo::pioneer
