// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "core/types/stamp.hpp"
#include "drivers/io/line_age.hpp"

namespace topo::pioneer {

/// Age of a status packet's pose at the time when its last byte has been read.
///
/// The robot sends packets at a constant cadence; a later arrival is due to a delay on the line. The earliest
/// arrivals, less their time on the wire, give the cadence (a running minimum over about six seconds, with
/// the robot's clock rate estimated from the change of that minimum), and the lateness of the others is their
/// delay. A delay common to all packets, beyond the time on the wire, cannot be observed from one side and is
/// not included.
class SipDelay {
 public:
  explicit SipDelay(types::Duration cycle = std::chrono::milliseconds(100));

  /// Age of the packet that arrived at `arrival` after `wire_time` on the line; 0 <= wire_time <= age.
  types::Duration update(types::Stamp arrival, types::Duration wire_time);

  /// Cycles between this packet and the previous one: 2 means that one was lost.
  [[nodiscard]] std::int64_t last_step() const { return last_step_; }
  [[nodiscard]] types::Duration age() const { return age_; }
  /// Wait on the line of the newest packet beyond the shortest of the connection (io::LineAge).
  [[nodiscard]] types::Duration late() const { return late_; }

 private:
  static constexpr std::size_t kWindow = 64;
  static constexpr std::size_t kRateBlock = 32;
  static constexpr double kRateMax = 0.01;  ///< of the cycle: more than any controller's timer is off
  struct Sample {
    std::int64_t index = 0;
    double lateness_s = 0.0;  ///< relative to the nominal cadence from the anchor
  };

  void restart(types::Stamp sent);
  [[nodiscard]] std::int64_t cycles_until(types::Stamp sent) const;
  void add(const Sample& sample);
  void learn_rate();
  [[nodiscard]] double envelope(std::int64_t index) const;

  double cycle_s_;
  bool started_ = false;
  types::Stamp anchor_{};  ///< origin of the nominal cadence
  std::int64_t index_ = 0;
  std::int64_t last_step_ = 1;
  std::array<Sample, kWindow> window_{};
  std::size_t count_ = 0;  ///< samples since the restart
  double rate_s_ = 0.0;    ///< excess of the true cycle over the nominal one
  Sample block_minimum_;
  Sample previous_minimum_;
  types::Duration age_{};
  io::LineAge line_age_{kRateMax};
  types::Duration late_{};
};

}  // namespace topo::pioneer
