// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "daemon/threads/hand_overs.hpp"
#include "daemon/threads/vitals.hpp"
#include "daemon/threads/worker.hpp"
#include "drivers/hokuyo/connection.hpp"

namespace topo::daemon {

/// A scan thread: sole user of one scanner. Decodes scans into the ring's slot. Allocates nothing while the
/// connection streams.
class ScanWorker final : public Worker {
 public:
  static constexpr types::Duration kTimeout = std::chrono::milliseconds(100);
  static constexpr types::Duration kCloseTime = std::chrono::milliseconds(500);

  /// `front`: true for the scanner that the base thread uses for stopping; every newest scan also goes to the
  /// base thread and to planning.
  ScanWorker(HandOvers& hand_overs, ScanHandOver& out, bool front,
             std::unique_ptr<hokuyo::Connection> connection, Vitals& vitals);

  /// The thread's body: runs until hand_overs.ending.devices_closing, then switches the laser off.
  void run() noexcept override;

 private:
  hokuyo::StepOutcome step();
  void note_ring_full(bool full);
  void report();

  HandOvers& hand_overs_;
  ScanHandOver& out_;
  bool front_;
  std::unique_ptr<hokuyo::Connection> connection_;
  Vitals& vitals_;
  std::unique_ptr<types::Scan> spare_ = std::make_unique<types::Scan>();  ///< used while the ring is full
  bool ring_full_ = false;
  types::Stamp next_report_{};
};

}  // namespace topo::daemon
