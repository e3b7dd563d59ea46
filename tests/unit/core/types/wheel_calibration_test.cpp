// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/types/wheel_calibration.hpp"

#include <gtest/gtest.h>

namespace topo::types {
namespace {

constexpr double kModelTrack_m = 0.357;

TEST(WheelCalibration, OfTheModelChangesNothing) {
  const Progress p = true_progress({}, kModelTrack_m, {0.7, -0.3});
  EXPECT_DOUBLE_EQ(p.way_m, 0.7);
  EXPECT_DOUBLE_EQ(p.turn_rad, -0.3);
}

TEST(WheelCalibration, LargerWheelsGoFurther) {
  const Progress p = true_progress({1.1, 1.1, 0.0}, kModelTrack_m, {1.0, 0.0});
  EXPECT_DOUBLE_EQ(p.way_m, 1.1);
  EXPECT_DOUBLE_EQ(p.turn_rad, 0.0);
}

TEST(WheelCalibration, LargerRightWheelTurnsToTheLeft) {
  const Progress p = true_progress({1.0, 1.04, 0.4}, kModelTrack_m, {1.0, 0.0});
  EXPECT_NEAR(p.way_m, 1.02, 1e-12);
  EXPECT_NEAR(p.turn_rad, 0.1, 1e-12);
}

TEST(WheelCalibration, WiderTrackTurnsLess) {
  EXPECT_NEAR(true_progress({1.0, 1.0, 2.0 * kModelTrack_m}, kModelTrack_m, {0.0, 1.0}).turn_rad, 0.5, 1e-12);
}

TEST(WheelCalibration, CommandIsTheInverse) {
  const WheelCalibration wheels{0.96, 1.04, 0.33};
  const Progress back =
      true_progress(wheels, kModelTrack_m, counted_progress(wheels, kModelTrack_m, {0.4, -0.9}));
  EXPECT_NEAR(back.way_m, 0.4, 1e-12);
  EXPECT_NEAR(back.turn_rad, -0.9, 1e-12);
}

}  // namespace
}  // namespace topo::types
