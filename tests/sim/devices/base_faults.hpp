// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "tests/sim/devices/arcos_sip.hpp"
#include "tests/sim/devices/sim_time.hpp"

namespace topo::sim {

/// An encoder that may stop to count while its wheel turns on.
class EncoderFault {
 public:
  void set(bool dead) { dead_ = dead; }
  [[nodiscard]] bool dead() const { return dead_; }
  /// What the controller counts when the wheel has gone so far, m.
  double count_m(double wheel_m) {
    if (dead_) missed_m_ += wheel_m - last_m_;
    last_m_ = wheel_m;
    return wheel_m - missed_m_;
  }

 private:
  bool dead_ = false;
  double last_m_ = 0.0;
  double missed_m_ = 0.0;
};

/// Which field of a valid status packet is wrong.
enum class StatusLie : std::uint8_t { kNone, kSpeed, kTurning, kPosition, kHeading };

/// Faults of a controller that answers in form and in time.
struct BaseFaults {
  bool disobeys = false;       ///< motion commands and stops are swallowed; all others work
  double lost_commands = 0.0;  ///< share of the commands that get lost as whole packets
  StatusLie lie = StatusLie::kNone;
  double lie_value = 0.0;  ///< m/s, rad/s; m and rad: every other packet is off by it
  EncoderFault left, right;
  bool stall_left = false, stall_right = false;
  SimTime stalled_until{0};
  std::optional<double> sonar_stuck_m;
  double battery_fall_vps = 0.0;
  SimTime battery_since{0};

  /// The packet as it leaves; `number` counts the packets.
  void spoil(arcos::Sip& sip, std::uint64_t number, double track_mm) const;
  [[nodiscard]] double battery_v(double full_v, SimTime now) const;
};

}  // namespace topo::sim
