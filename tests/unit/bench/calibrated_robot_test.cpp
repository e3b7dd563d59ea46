// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/calibrate/calibrated_robot.hpp"

#include <gtest/gtest.h>

#include "tests/bench/topobench/calibrate/calibration_error.hpp"

namespace topo::bench {
namespace {

TEST(CalibratedRobot, SetupTellsTheScannersApartWhicheverComesFirst) {
  for (const bool swapped : {false, true}) {
    const auto made = set_up({}, swapped, 1);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_TRUE(made->told_apart);
    EXPECT_NE(made->configuration.front.serial_number, made->configuration.coronal.serial_number);
    EXPECT_EQ(made->configuration.front.x_m, TapeMeasured{}.T_base_laser.x_m);
    EXPECT_LE(made->answers, 12);
  }
}

/// A robot as the errors are told of it, without the drive.
CalibratedRobot known_robot() {
  CalibratedRobot robot;
  robot.true_wheels = {0.96, 1.04, 0.33};
  robot.configuration = right_configuration(robot);
  return robot;
}

TEST(CalibratedRobot, TheRightConfigurationHasNoError) {
  for (const double error : errors_of(known_robot())) EXPECT_NEAR(error, 0.0, 1e-9);
}

TEST(CalibratedRobot, ErrorsHaveTheUnitsOfTheirNames) {
  CalibratedRobot robot = known_robot();
  daemon::Configuration& wrong = robot.configuration;
  wrong.front.yaw_rad -= types::kDegree_rad;
  wrong.front.y_m += 0.003;
  wrong.base.wheels.right *= 0.99;
  wrong.base.wheels.track_m *= 1.02;
  wrong.base.status_delay_s -= 0.004;
  wrong.coronal.roll_rad += 2.0 * types::kDegree_rad;
  wrong.coronal.z_m -= 0.005;
  const Errors errors = errors_of(robot);
  const Errors expected{1.0, 3.0, 1.0, 2.0, 4.0, 2.0, 5.0};
  for (std::size_t i = 0; i < errors.size(); ++i)
    EXPECT_NEAR(errors[i], expected[i], 1e-6) << kErrorKinds[i].name;
}

}  // namespace
}  // namespace topo::bench
