// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "tests/sim/devices/sim_time.hpp"

namespace topo::sim {

/// A sensor's own clock: milliseconds in 24 bits, with its own rate (PROTOCOLS section 12).
class DeviceClock {
 public:
  DeviceClock(double offset_ms, double drift_ppm) : offset_ms_(offset_ms), rate_(1.0 + drift_ppm * 1e-6) {}

  /// The counter at a time of the simulation; wraps every 16777.216 s of its own time.
  [[nodiscard]] std::uint32_t ticks_ms(SimTime now) const {
    constexpr double kWrap = 16777216.0;
    const double ms = std::floor(offset_ms_ + seconds_of(now - zero_) * 1e3 * rate_);
    return static_cast<std::uint32_t>(ms - kWrap * std::floor(ms / kWrap)) & 0xFFFFFFU;
  }
  void reset(SimTime now) {
    zero_ = now;
    offset_ms_ = 0.0;
  }
  void jump(double ms) { offset_ms_ += ms; }

 private:
  SimTime zero_{0};
  double offset_ms_;
  double rate_;
};

}  // namespace topo::sim
