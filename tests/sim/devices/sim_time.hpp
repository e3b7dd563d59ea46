// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

namespace topo::sim {

/// Time since the simulation's start. The simulator's devices never read a clock: time is a parameter.
using SimTime = std::chrono::nanoseconds;

constexpr double seconds_of(SimTime t) { return std::chrono::duration<double>(t).count(); }
constexpr SimTime sim_seconds(double seconds) {
  return std::chrono::duration_cast<SimTime>(std::chrono::duration<double>(seconds));
}

}  // namespace topo::sim
