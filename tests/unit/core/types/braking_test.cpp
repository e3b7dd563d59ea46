// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/types/braking.hpp"

#include <gtest/gtest.h>

namespace topo::types {
namespace {

TEST(Braking, GoesAsFarAsSmallStepsOfSlowingDownDo) {
  for (const double v_mps : {0.1, 0.7, 1.2}) {
    double way_m = 0.0;
    const double step_s = 1e-4;
    for (double now_mps = v_mps; now_mps > 0.0; now_mps -= 0.5 * step_s) way_m += now_mps * step_s;
    EXPECT_NEAR(braking_m(v_mps, 0.5), way_m, 1e-3);
    EXPECT_DOUBLE_EQ(braking_m(-v_mps, 0.5), -braking_m(v_mps, 0.5)) << "backwards";
  }
  EXPECT_EQ(braking_m(0.0, 0.5), 0.0);
}

}  // namespace
}  // namespace topo::types
