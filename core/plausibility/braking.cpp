// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/plausibility/braking.hpp"

#include <algorithm>
#include <cmath>

namespace topo::plausibility {
namespace {

/// True when the command fell at least as fast as believed: it was nearly zero when a robot that brakes as
/// believed would have gone from fast_share of its speed to standstill.
bool brakes_fully(const CommandHistory& commands, types::Stamp fast, double top_mps, double believed_mps2,
                  const BrakingParams& params) {
  const types::Duration ramp = types::from_seconds(params.fast_share * top_mps / believed_mps2);
  return std::abs(commands.at(fast + ramp).v_mps) < params.slow_share * top_mps;
}

}  // namespace

void Braking::judge(const CommandHistory& commands, const types::BaseState& state, double believed_mps2) {
  const types::Stamp now = state.odometry.stamp;
  const double v_mps = std::abs(state.odometry.twist.v_mps);
  if (v_mps >= top_mps_ || !state.motors_enabled) {
    top_mps_ = state.motors_enabled && v_mps >= params_.top_mps ? v_mps : 0.0;
    fast_ = {};
    return;
  }
  if (top_mps_ == 0.0) return;
  if (fast_ == types::Stamp{} && v_mps <= params_.fast_share * top_mps_) {
    fast_ = now;
    fast_mps_ = v_mps;
  }
  if (v_mps > params_.slow_share * top_mps_) return;
  const double elapsed_s = types::to_seconds(now - fast_);
  if (elapsed_s > 0.0 && fast_mps_ > v_mps &&
      brakes_fully(commands, fast_, top_mps_, believed_mps2, params_)) {
    const double found = (fast_mps_ - v_mps) / elapsed_s;
    const bool first_or_worse = measured_mps2_ == 0.0 || found < measured_mps2_;
    measured_mps2_ = first_or_worse ? found : measured_mps2_ + params_.forget * (found - measured_mps2_);
  }
  top_mps_ = 0.0;
}

}  // namespace topo::plausibility
