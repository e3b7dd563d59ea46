// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/plausibility/motors_check.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace topo::plausibility {
namespace {

using std::chrono::milliseconds;

/// A base whose motors are as they are set, with a status every 100 ms.
struct Motors {
  MotorsCheck check;
  types::BaseState state;
  bool first = true;

  Motors() { state.arrival = types::stamp_from_seconds(100.0); }
  /// True when they were switched off meanwhile.
  bool run(int cycles, bool wanted, bool on) {
    bool off = false;
    state.motors_enabled = on;
    for (int i = 0; i < cycles; ++i) {
      state.arrival += milliseconds(100);
      check.want(state.arrival, wanted);
      off = check.judge(state, std::exchange(first, false)) || off;
    }
    return off;
  }
};

TEST(MotorsCheck, theButtonIsNoticed) {
  Motors motors;
  EXPECT_FALSE(motors.run(5, true, false)) << "not yet on";
  EXPECT_FALSE(motors.run(20, true, true));
  EXPECT_TRUE(motors.run(1, true, false));
  EXPECT_FALSE(motors.run(20, true, false)) << "once";
}

TEST(MotorsCheck, theHostsOwnRequestIsNone) {
  Motors motors;
  motors.run(20, true, true);
  EXPECT_FALSE(motors.run(3, false, true));
  EXPECT_FALSE(motors.run(1, false, false));
  motors.run(20, true, true);
  motors.run(2, false, true);
  EXPECT_FALSE(motors.run(3, true, true)) << "wanted again";
  EXPECT_FALSE(motors.run(5, true, false)) << "the request of before";
}

TEST(MotorsCheck, theStopButtonIsAnEStop) {
  Motors motors;
  motors.run(20, true, true);
  motors.state.stop_button = true;
  EXPECT_FALSE(motors.run(5, true, false));
}

TEST(MotorsCheck, aNewConnectionBeginsWithMotorsOff) {
  Motors motors;
  motors.run(20, true, true);
  motors.first = true;
  EXPECT_FALSE(motors.run(5, true, false));
}

}  // namespace
}  // namespace topo::plausibility
