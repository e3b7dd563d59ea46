// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "core/motion/velocity_gate.hpp"
#include "tests/unit/core/motion/surroundings.hpp"

namespace topo::motion {

using std::chrono::milliseconds;
using types::Duration;
using types::Stamp;
using types::Twist2;

constexpr Duration kPeriod = milliseconds(50);

/// A robot, its fresh data, and the gate's state.
struct Scene {
  Stamp now{std::chrono::seconds(100)};
  types::BaseState base;
  std::unique_ptr<types::Scan> scan = empty_scan(now);
  GateState state;
  GateInput input;
  std::vector<perception::ScanPoint> posts;

  Scene() {
    input.firmware_watchdog = milliseconds(500);
    input.request.enable_motors = true;
    freshen();
  }
  void freshen() {
    base.arrival = now - milliseconds(50);
    scan->first_beam = now - milliseconds(45);
    scan->arrival = now - milliseconds(20);
    input.now = now;
    input.request.stamp = now - milliseconds(10);
    input.base = &base;
    input.front_scan = scan.get();
  }
  GateOutput ask(double v_mps, double omega_radps = 0.0) {
    now += kPeriod;
    freshen();
    input.request.twist = {v_mps, omega_radps};
    return gate(state, input);
  }
  GateOutput settle(double v_mps, double omega_radps = 0.0) {
    GateOutput out;
    for (int i = 0; i < 60; ++i) out = ask(v_mps, omega_radps);
    return out;
  }
  /// As it stands, without freshening.
  GateOutput again() { return gate(state, input); }
};

inline bool stands(const GateOutput& out) { return out.command.twist == Twist2{}; }

}  // namespace topo::motion
