// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/plausibility/braking.hpp"

#include <gtest/gtest.h>

#include "tests/unit/core/plausibility/driven_base.hpp"

namespace topo::plausibility {
namespace {

double measured_after_a_stop(double braking_mps2, double speed_mps, bool at_once) {
  testing::DrivenBase base;
  testing::Ramp ramp;
  base.braking_mps2 = braking_mps2;
  CommandHistory commands;
  Braking braking;
  for (int i = 0; i < 300; ++i) {
    const bool stops = i >= 120;
    if (stops && at_once) ramp.stop();
    const types::Twist2 commanded =
        stops && at_once ? types::Twist2{} : ramp.towards({stops ? 0.0 : speed_mps, 0.0});
    const bool heard = base.step(commanded);
    commands.add(base.now, commanded, {});
    if (heard) braking.judge(commands, base.state, 0.5);
  }
  return braking.measured_mps2();
}

TEST(Braking, measuresWhatTheWheelsDo) {
  for (const double braking_mps2 : {0.2, 0.3, 0.5}) {
    const double found = measured_after_a_stop(braking_mps2, 0.7, true);
    EXPECT_NEAR(found, braking_mps2, 0.15 * braking_mps2);
  }
}

TEST(Braking, tellsWeakBrakes) {
  testing::DrivenBase base;
  Braking braking;
  EXPECT_FALSE(braking.is_weak(0.5));
  EXPECT_LT(measured_after_a_stop(0.3, 0.7, true), 0.8 * 0.5);
  EXPECT_GT(measured_after_a_stop(0.5, 0.7, true), 0.8 * 0.5);
  EXPECT_GT(measured_after_a_stop(0.5, 0.7, false), 0.8 * 0.5);
}

TEST(Braking, slowDrivesMeasureNothing) { EXPECT_EQ(measured_after_a_stop(0.5, 0.2, true), 0.0); }

}  // namespace
}  // namespace topo::plausibility
