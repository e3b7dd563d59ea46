// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/types/base_state.hpp"
#include "drivers/pioneer/link.hpp"
#include "drivers/pioneer/robot_info.hpp"

namespace topo::pioneer {

/// What a running connection sends: the caller's setpoints, a stop when the caller falls silent, a pulse when
/// nothing else goes out, and the motors' switch. Decides from stamps given as values.
class Drive {
 public:
  /// Queues the first commands of a connection: standstill, limits, sonar. `now` counts as the first status.
  Drive(Outbox& outbox, const DriveLimits& limits, bool sonar, bool may_move, types::Stamp now);

  /// kUnsupported when motion or motors are asked for and may not be; a stop goes out in its place.
  types::Status command(const types::BaseCommand& command, types::Stamp now);
  void on_state(const types::BaseState& state, types::Stamp now);
  /// What is due: `last_send` is when the line was used last.
  void keep_alive(types::Stamp now, types::Stamp last_send);
  /// When keep_alive() has to be called again at the latest.
  [[nodiscard]] types::Stamp next_due(types::Stamp last_send) const;
  /// The connection ends: the motors' switch is left to the caller.
  void shut_down() { ever_commanded_ = false; }
  [[nodiscard]] bool stands() const { return stands_; }
  /// By what was heard last, or by what was asked for last.
  [[nodiscard]] bool may_be_moving() const { return !stands_ || asked_; }

 private:
  void stop(types::Stamp now);
  void switch_motors(const types::BaseState& state, types::Stamp now);

  Outbox& outbox_;
  DriveLimits limits_;
  bool may_move_;
  bool commanded_ = false;  ///< the caller drives; false again after its silence
  bool stopping_ = false;   ///< a stop was sent for it and the robot does not stand yet
  bool stands_ = true;
  bool asked_ = false;  ///< the last setpoints are motion
  bool ever_commanded_ = false;
  bool want_motors_ = false;
  bool enable_blocked_ = false;  ///< after the stop button, until the caller has let go
  types::Stamp last_command_{};
  types::Stamp last_heard_;
  types::Stamp last_stop_{};
  types::Stamp last_switch_{};
};

}  // namespace topo::pioneer
