// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>

#include "core/calibration/calibrate.hpp"
#include "tests/bench/topobench/calibrate/hand_drive.hpp"

namespace topo::calibration {

using bench::Course;

/// The robot of the bars, with the wheels that the simulator drew.
struct Truth : bench::TrueRobot {
  types::WheelCalibration wheels{};
};

inline Assumed assumed() {
  const bench::TapeMeasured tape;
  Assumed out;
  out.numbers = {{}, tape.T_base_laser, 0.0};
  out.front_z_m = bench::kLevelHeight_m;
  out.coronal = tape.coronal;
  return out;
}

/// Drives a simulated robot in lock-step and keeps what was measured. Sets the truth's wheels.
inline DriveLog driven(const Course& course, std::uint64_t seed, Truth& truth) {
  auto drive = bench::drive_by_hand(course, truth, seed);
  if (!drive) {
    ADD_FAILURE() << drive.error().message;
    std::abort();
  }
  truth.wheels = drive->true_wheels;
  return std::move(drive->log);
}

}  // namespace topo::calibration
