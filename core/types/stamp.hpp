// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

namespace topo::types {

using Duration = std::chrono::nanoseconds;

/// The host's steady clock (CLOCK_MONOTONIC) as a type without now(): code receives the time as a value, and
/// only the daemon and the byte streams can read the clock.
struct HostClock {
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<HostClock, Duration>;
  static constexpr bool is_steady = true;
};

using Stamp = HostClock::time_point;

/// Seconds since the clock's origin, and between stamps; for formulas, reports and files only.
constexpr double to_seconds(Duration d) { return std::chrono::duration<double>(d).count(); }
constexpr double to_seconds(Stamp t) { return to_seconds(t.time_since_epoch()); }
constexpr Duration from_seconds(double seconds) {
  return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds));
}
constexpr Stamp stamp_from_seconds(double seconds) { return Stamp{from_seconds(seconds)}; }

}  // namespace topo::types
