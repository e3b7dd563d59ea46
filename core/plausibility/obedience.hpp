// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "core/plausibility/command_history.hpp"
#include "core/plausibility/params.hpp"
#include "core/types/base_state.hpp"
#include "core/types/robot_limits.hpp"

namespace topo::plausibility {

/// Bounds of the speed that an obeying base may have: the slowest lag and braking that are believed, between
/// the commands of the past.
struct SpeedBounds {
  double low = 0.0, high = 0.0;
};

struct ObedienceOpinion {
  bool disobeys = false;
  bool late = false;
  types::Duration lag{};  ///< from a command to the wheels; the longest that was too long, else the newest
};

/// Compares the speed of every status with the commands before it.
///
/// Disobedience: the speed leaves the bounds, or goes on for seconds while the bounds allow none. Lag: for
/// every lag of a grid the squared difference between the speed and that of a prompt base so long ago
/// (CommandHistory::followed_at) is summed over the statuses around changes; the best lag is the estimate
/// (matched filter). A base that stands still although it is commanded to move is not disobedient: it may be
/// blocked, which control notices.
class Obedience {
 public:
  /// Grid of the lags: the control period, in which commands change, up to 2 s. Size of an array.
  static constexpr types::Duration kLagStep = types::kBasePeriod;
  static constexpr std::size_t kLags = 41;

  explicit Obedience(const ObedienceParams& params = {}) : params_(params) {}

  /// `state`: a new status. Motors that are off obey nothing and move by hand.
  ObedienceOpinion judge(const CommandHistory& commands, const types::BaseState& state,
                         const types::DriveLimits& limits);

  /// Measures the lag anew. A lag that was too long stays known, and a delayed motion is no disobedience.
  void measure_anew();
  /// Forgets everything.
  void reset();

 private:
  void follow(SpeedBounds& bounds, double commanded, double braking, double elapsed_s) const;
  /// True when the base has gone on for long although it is to stand.
  bool creeps(const types::Twist2& measured);
  /// True when the status says something about the lag.
  bool measure_lag(const CommandHistory& commands, const types::BaseState& state);
  [[nodiscard]] std::size_t best_lag(std::size_t end) const;

  ObedienceParams params_;
  SpeedBounds v_, omega_;
  types::Stamp last_{};
  types::Stamp motors_on_{};  ///< the newest status without them
  int outside_ = 0;
  types::Stamp stood_{};  ///< the newest status that stood, or was allowed to move
  std::array<double, kLags> error_{};
  types::Duration late_lag_{};  ///< the longest lag that was too long
  double weight_ = 0.0;
  int informative_ = 0;
};

}  // namespace topo::plausibility
