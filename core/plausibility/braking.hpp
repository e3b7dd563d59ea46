// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/plausibility/command_history.hpp"
#include "core/plausibility/params.hpp"
#include "core/types/base_state.hpp"

namespace topo::plausibility {

/// Measures the deceleration at stops: between two shares of the speed at which a stop began, when the
/// command fell at least as fast as believed. Slower commands measure the command, not the brakes.
class Braking {
 public:
  explicit Braking(const BrakingParams& params = {}) : params_(params) {}
  /// `state`: a new status; `believed_mps2`: the deceleration by which the robot's stopping distance is
  /// computed.
  void judge(const CommandHistory& commands, const types::BaseState& state, double believed_mps2);

  /// The smallest of the last stops' decelerations; 0 before the first.
  [[nodiscard]] double measured_mps2() const { return measured_mps2_; }
  /// True when the robot brakes with less than BrakingParams::weak_share of what is believed.
  [[nodiscard]] bool is_weak(double believed_mps2) const {
    return measured_mps2_ > 0.0 && measured_mps2_ < params_.weak_share * believed_mps2;
  }

 private:
  BrakingParams params_;
  double top_mps_ = 0.0;  ///< of the present stop; 0: none
  types::Stamp fast_{};   ///< when the speed fell below fast_share of it
  double fast_mps_ = 0.0;
  double measured_mps2_ = 0.0;
};

}  // namespace topo::plausibility
