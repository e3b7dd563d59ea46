// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "core/pipeline/control_step.hpp"
#include "daemon/threads/hand_overs.hpp"
#include "daemon/threads/vitals.hpp"
#include "daemon/threads/worker.hpp"
#include "drivers/pioneer/connection.hpp"

namespace topo::daemon {

/// The base thread: sole user of the robot's connection. Reads status packets as they arrive, and at every
/// whole 50 ms decides on and sends one command. Allocates nothing while the connection streams.
class BaseWorker final : public Worker {
 public:
  static constexpr types::Duration kPeriod = types::kBasePeriod;
  static constexpr types::Duration kCloseTime = std::chrono::milliseconds(800);

  BaseWorker(HandOvers& hand_overs, const pipeline::ControlSetup& setup,
             const pipeline::ControlParams& params, std::unique_ptr<pioneer::Connection> connection,
             Vitals& vitals);

  /// The thread's body: runs until hand_overs.ending.devices_closing, then closes the connection in order.
  void run() noexcept override;

 private:
  void serve_until(types::Stamp deadline);
  void take_state();
  void decide();
  [[nodiscard]] pipeline::ControlInput gather();
  void report();

  HandOvers& hand_overs_;
  std::unique_ptr<pioneer::Connection> connection_;
  Vitals& vitals_;
  types::BaseState incoming_, state_;
  bool has_state_ = false;
  pipeline::ControlSetup setup_;
  pipeline::ControlState control_;
  pipeline::ControlReport control_report_;
  std::uint64_t releases_ = 0;  ///< of the connection, that control knows of
};

}  // namespace topo::daemon
