// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "core/pipeline/control_step.hpp"
#include "drivers/hokuyo/connection.hpp"
#include "drivers/pioneer/connection.hpp"
#include "tests/fuzz/drive/world.hpp"

namespace topo::fuzz {

/// The daemon's side, as daemon/threads/base_worker.cpp and scan_worker.cpp have it, in lock-step: both
/// drivers at their lines, and the step of control every 50 ms.
class Host {
 public:
  explicit Host(World& world);

  /// One control period: serves both lines, then decides.
  void period();
  /// The host does nothing for so long (stopped, suspended), and decides before it has read anything.
  void sleep(types::Duration duration);
  void unplug_base(bool unplugged) { base_port_.unplugged = unplugged; }
  void unplug_scanner(bool unplugged) { scan_port_.unplugged = unplugged; }

  types::Twist2 wish;  ///< of the operator
  bool estop = false, estop_cleared = false;

  [[nodiscard]] types::Stamp now() const { return base_port_.now; }
  [[nodiscard]] bool ready() const {
    return base_.health() == pioneer::Health::kReady && front_.health() == hokuyo::Health::kStreaming;
  }
  /// What was decided, and whether it was sent.
  [[nodiscard]] const pipeline::ControlOutput& output() const { return output_; }
  [[nodiscard]] bool sent() const { return sent_; }
  /// In the newest decision.
  [[nodiscard]] bool estop_pressed() const { return estop; }
  [[nodiscard]] const types::BaseState& state() const { return state_; }
  [[nodiscard]] const pioneer::Connection& base() const { return base_; }

 private:
  void serve(types::Stamp until);
  void decide();

  HostilePort base_port_, scan_port_;
  pioneer::Connection base_;
  hokuyo::Connection front_;
  pipeline::ControlSetup setup_;
  pipeline::ControlState control_;
  pipeline::Teleop teleop_;
  pipeline::ControlOutput output_;
  types::BaseState incoming_, state_;
  std::unique_ptr<types::Scan> scan_, incoming_scan_;
  bool has_state_ = false, has_scan_ = false, sent_ = false;
  std::uint64_t releases_ = 0;
};

}  // namespace topo::fuzz
