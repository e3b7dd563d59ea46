// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/calibration/calibrate.hpp"
#include "core/types/result.hpp"
#include "daemon/config/configuration.hpp"
#include "tests/bench/topobench/calibrate/true_robot.hpp"

namespace topo::bench {

/// What the dialogue of `topoctl setup` makes of a robot.
struct SetUp {
  daemon::Configuration configuration;
  int answers = 0;
  bool told_apart = false;  ///< its level scanner is the one that is level
};

/// A robot of the bars of README "The first hour", from an empty configuration on.
struct CalibratedRobot {
  TrueRobot truth;
  types::WheelCalibration true_wheels;
  SetUp set_up;
  calibration::Calibration found;
  daemon::Configuration configuration;  ///< with what was found
};

/// The daemon's own dialogue, answered from the tape measure, by a person who stands where it asks.
/// `swapped`: the upright scanner has the name that comes first. An error when the dialogue ends without a
/// configuration.
types::Result<SetUp> set_up(const TrueRobot& truth, bool swapped, std::uint64_t seed);

/// Setup, a drive by hand of three minutes, and calibration, as `topoctl setup` and `topoctl calibrate
/// --write` have them. Half of the seeds have their scanners swapped. An error also when what was found is
/// not believable.
types::Result<CalibratedRobot> calibrated_robot(std::uint64_t seed);

/// The configuration of a robot of which all is known, from that of setup.
daemon::Configuration right_configuration(const CalibratedRobot& robot);

}  // namespace topo::bench
