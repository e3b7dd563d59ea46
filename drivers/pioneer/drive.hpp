// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/types/base_state.hpp"
#include "drivers/pioneer/link.hpp"
#include "drivers/pioneer/robot_info.hpp"
#include "drivers/pioneer/watchdog_trial.hpp"

namespace topo::pioneer {

/// Commands of a running connection: the caller's setpoints, a stop when the caller is silent, a pulse when
/// the line is idle, and the motors' switch. Time is passed as stamps.
class Drive {
 public:
  /// Queues the first commands of a connection: standstill, limits, sonar. `now` counts as the first status.
  Drive(Outbox& outbox, const DriveLimits& limits, bool sonar, bool may_move, types::Stamp now);

  /// Until the result is known nothing but a turn on the spot is sent, and no pulse in its silence.
  void put_on_trial(const WatchdogTrial::Params& params) { trial_.emplace(params); }
  /// Nothing without a trial.
  [[nodiscard]] const std::optional<WatchdogTrial>& trial() const { return trial_; }

  /// kUnsupported when motion or motors are requested but not allowed; a stop is sent instead.
  types::Status command(const types::BaseCommand& command, types::Stamp now);
  void on_state(const types::BaseState& state, types::Stamp now);
  /// Queues commands that are due; `last_send` is the last use of the line.
  void keep_alive(types::Stamp now, types::Stamp last_send);
  /// Latest time of the next call of keep_alive().
  [[nodiscard]] types::Stamp next_due(types::Stamp last_send) const;
  /// The connection ends: from now on the caller controls the motors' switch.
  void shut_down() { ever_commanded_ = false; }
  [[nodiscard]] bool stands() const { return stands_; }
  /// Nothing may be sent, by whatever part of the connection.
  [[nodiscard]] bool is_silent() const { return silent_ || (trial_ && trial_->silent()); }
  /// According to the last status or the last request.
  [[nodiscard]] bool may_be_moving() const { return !stands_ || asked_; }

 private:
  static constexpr int kLastWords = 3;  ///< one may be lost on the line
  void fall_silent();
  [[nodiscard]] bool on_trial() const {
    return trial_ && trial_->result() == WatchdogTrial::Result::kPending;
  }
  void end_trial_if_due(types::Stamp now);
  void stop(types::Stamp now);
  void switch_motors(const types::BaseState& state, types::Stamp now);

  Outbox& outbox_;
  DriveLimits limits_;
  bool may_move_;
  bool commanded_ = false;  ///< the caller drives; false after its silence
  bool stopping_ = false;   ///< a stop was sent after the caller's silence, and the robot still moves
  bool stands_ = true;
  int last_words_ = kLastWords;  ///< E_STOPs that are left to be sent before silence
  bool silent_ = false;          ///< the base does not obey: nothing feeds its watchdog
  bool asked_ = false;           ///< the last setpoints request motion
  bool ever_commanded_ = false;
  bool want_motors_ = false;
  bool enable_blocked_ = false;  ///< after the stop button, until the caller stops requesting the motors
  std::optional<WatchdogTrial> trial_;
  types::Stamp last_command_{};
  types::Stamp last_heard_;
  types::Stamp last_stop_{};
  types::Stamp last_switch_{};
};

}  // namespace topo::pioneer
