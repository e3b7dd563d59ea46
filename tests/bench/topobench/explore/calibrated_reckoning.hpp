// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/types/base_state.hpp"
#include "core/types/wheel_calibration.hpp"
#include "drivers/pioneer/dead_reckoning.hpp"

namespace topo::bench {

/// The driver's dead reckoning of a P3-DX, from what its firmware tells.
class CalibratedReckoning {
 public:
  /// `wheels`: as the driver is told that they are; those of the model: what the firmware tells is passed on.
  explicit CalibratedReckoning(const types::WheelCalibration& wheels);

  /// The next status packet's odometry as the firmware reckons it, in whole millimetres and 4096 headings.
  types::Odometry update(const types::Odometry& counted);

 private:
  types::WheelCalibration wheels_;
  pioneer::RobotModel model_;
  pioneer::DeadReckoning reckoning_;
  types::Stamp last_{};
};

}  // namespace topo::bench
