// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "core/calibration/drive_log.hpp"
#include "core/types/result.hpp"
#include "tests/bench/topobench/calibrate/true_robot.hpp"
#include "tests/sim/simulation.hpp"

namespace topo::bench {

/// A room of 8 x 6 m with things in it.
std::string furnished_room();

struct Course {
  std::string world = furnished_room();
  sim::Difficulty difficulty = difficulty_of_its_wheels();
  double seconds = 180.0;
  bool coronal = true;
  /// The wheels' drive; null: as a person drives by hand, round the furnished room and through its middle,
  /// both ways round.
  sim::WheelDrive* drive = nullptr;
  /// Changes a front scan in place, by its time in seconds; null: as it is.
  std::function<void(types::Scan&, double)> spoil = nullptr;
};

/// What was measured on a drive, and what the simulator drew.
struct HandDrive {
  calibration::DriveLog log;
  types::WheelCalibration true_wheels;
};

/// Drives a simulated P3-DX in lock-step. An error when the world is none, or the robot touched something.
types::Result<HandDrive> drive_by_hand(const Course& course, const TrueRobot& truth, std::uint64_t seed);

}  // namespace topo::bench
