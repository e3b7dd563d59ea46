// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/types/base_state.hpp"
#include "drivers/pioneer/setpoints.hpp"

namespace topo::pioneer {

/// Measures whether the firmware stops the wheels when nothing is sent: the only way to know a watchdog that
/// the firmware does not tell. The robot turns on the spot, because that needs no way; what may move it is
/// decided as ever, every period, and any change of the setpoints ends the silence. Sans-I/O; time is passed
/// as stamps.
class WatchdogTrial {
 public:
  struct Params {
    types::Duration given{};  ///< that the configuration claims
    /// Beyond the claim: braking from the turn, and the age of the status that shows it.
    types::Duration grace = std::chrono::milliseconds(500);
    types::Duration steady = std::chrono::milliseconds(300);  ///< the wheels turn so long before the silence
    double turning_radps = 0.05;  ///< the wheels turn, by the status; below half of it they stand
    /// Without a status for so long the wheels are not watched (types::RobotLimits::status_age_max).
    types::Duration unheard = std::chrono::milliseconds(300);
  };
  enum class Result {
    kPending,
    kPassed,
    kFailed,  ///< the wheels turned on
  };

  explicit WatchdogTrial(const Params& params) : params_(params) {}

  /// The setpoints that the caller is about to send; none that drive forwards may be among them. True:
  /// nothing may be sent now.
  [[nodiscard]] bool withholds(const Setpoints& setpoints, bool estop, types::Stamp now);
  void on_state(const types::BaseState& state, types::Stamp now);
  /// To be called regularly. True: the silence ended without a result and an E_STOP is due.
  [[nodiscard]] bool must_stop(types::Stamp now);

  [[nodiscard]] bool silent() const { return silent_since_ != types::Stamp{}; }
  [[nodiscard]] types::Stamp deadline() const { return silent_since_ + params_.given + params_.grace; }
  [[nodiscard]] Result result() const { return result_; }
  /// From the last packet to the first status of a standing robot; of kPassed.
  [[nodiscard]] types::Duration measured() const { return measured_; }

 private:
  Params params_;
  Result result_ = Result::kPending;
  Setpoints last_;
  types::Stamp last_sent_{};
  types::Stamp turning_since_{};
  types::Stamp heard_{};
  types::Stamp silent_since_{};  ///< zero: not silent
  types::Duration measured_{};
};

}  // namespace topo::pioneer
