// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/pipeline/control_step.hpp"

namespace topo::pipeline {

using motion::GateReason;
using std::chrono::milliseconds;

/// The same scan again and again, in an empty place, and poses put where a test wants them: what
/// core/plausibility is for is tested there.
inline ControlParams trusting() {
  ControlParams params;
  plausibility::PlausibilityParams& p = params.plausibility;
  p.picture.noiseless = p.picture.open_space = true;
  p.motion.step_m = p.motion.step_rad = 1e6;
  return params;
}

class ControlStepTest : public ::testing::Test {
 protected:
  ControlStepTest() {
    scan->geometry = {-2.356F, 0.004363F, 0.000017F, 0.025F, 0.1F, 30.0F};
    scan->beams = 1081;
    scan->range_m.fill(10.0F);
    scan->first_beam = scan->arrival = now;
    state.arrival = now;
    drive = {now, {0.3, 0.0}};
    input.now = now;
    input.teleop = &drive;
    input.state = &state;
    input.front = scan.get();
    input.firmware_watchdog = milliseconds(500);
  }
  /// Some periods of the same input, with everything in it kept fresh.
  ControlOutput run(int periods) {
    ControlOutput decision;
    for (int i = 0; i < periods; ++i) {
      now += milliseconds(50);
      input.now = state.arrival = scan->arrival = scan->first_beam = now;
      if (keep_asking) drive.stamp = now;
      decision = control_step(memory, setup, input);
      input.estop_cleared = false;
    }
    return decision;
  }

  types::Stamp now = types::stamp_from_seconds(100.0);
  std::unique_ptr<types::Scan> scan = std::make_unique<types::Scan>();
  types::BaseState state;
  Teleop drive;
  ControlSetup setup;
  ControlInput input;
  ControlState memory{trusting()};
  bool keep_asking = true;
};

inline Plan plan_ahead(types::Stamp stamp) {
  Plan plan;
  plan.stamp = stamp;
  plan.sequence = plan.goal_id = 1;
  plan.moving = plan.path_ends_at_goal = plan.located = true;
  plan.points = 50;
  for (std::size_t i = 0; i < plan.points; ++i) plan.path_odom[i] = {0.1 * static_cast<double>(i), 0.0};
  return plan;
}

/// A round post, in the laser's frame.
inline void put_post(types::Scan& scan, const types::Vector2& at, double radius_m) {
  for (std::size_t i = 0; i < scan.beams; ++i) {
    const double angle = static_cast<double>(scan.angle_rad(i));
    const double along = at.dot(types::Vector2(std::cos(angle), std::sin(angle)));
    const double through = radius_m * radius_m - at.squaredNorm() + along * along;
    if (along > 0.0 && through > 0.0) scan.range_m[i] = static_cast<float>(along - std::sqrt(through));
  }
}

/// A person walks to and fro across the way, 0.6 m ahead, two metres to either side.
inline void put_walker(types::Scan& scan, double t_s) {
  constexpr double kAhead_m = 0.6, kAside_m = 2.0, kSpeed_mps = 1.0;
  const double way_m = std::fmod(kSpeed_mps * t_s, 4.0 * kAside_m);
  const types::Vector2 at(kAhead_m, way_m < 2.0 * kAside_m ? way_m - kAside_m : 3.0 * kAside_m - way_m);
  scan.range_m.fill(10.0F);
  put_post(scan, at, 0.2);
}

}  // namespace topo::pipeline
