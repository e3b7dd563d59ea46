// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/plausibility/command_history.hpp"
#include "core/types/base_state.hpp"

namespace topo::plausibility {

/// Measures the deceleration at stops: from 80 % to 20 % of the speed at which a stop began, when the command
/// fell at least as fast as believed. Slower commands measure the command, not the brakes.
class Braking {
 public:
  /// `state`: a new status; `believed_mps2`: the deceleration by which the robot's stopping distance is
  /// computed.
  void judge(const CommandHistory& commands, const types::BaseState& state, double believed_mps2);

  /// The smallest of the last stops' decelerations; 0 before the first.
  [[nodiscard]] double measured_mps2() const { return measured_mps2_; }
  /// True when the robot brakes with less than 80 % of what is believed.
  [[nodiscard]] bool is_weak(double believed_mps2) const {
    return measured_mps2_ > 0.0 && measured_mps2_ < 0.8 * believed_mps2;
  }

 private:
  double top_mps_ = 0.0;  ///< of the present stop; 0: none
  types::Stamp fast_{};   ///< when the speed fell below 80 % of it
  double fast_mps_ = 0.0;
  double measured_mps2_ = 0.0;
};

}  // namespace topo::plausibility
