// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "core/types/se2.hpp"
#include "core/types/wheel_calibration.hpp"

namespace topo::calibration {

/// What a drive calibrates: wheels, place of the front scanner, delay of status packets.
struct RobotNumbers {
  types::WheelCalibration wheels;  ///< with a track
  types::Se2 T_base_laser;
  double delay_s = 0.0;  ///< by which the stamps of odometry are too late against those of the front scanner
};

/// Their order in a vector and in its covariance matrix.
enum Number { kWheelLeft, kWheelRight, kTrack, kYaw, kPlaceX, kPlaceY, kDelay, kNumbers };
using Vector = Eigen::Matrix<double, kNumbers, 1>;
using Matrix = Eigen::Matrix<double, kNumbers, kNumbers>;

[[nodiscard]] inline Vector to_vector(const RobotNumbers& s) {
  Vector v;
  v << s.wheels.left, s.wheels.right, s.wheels.track_m, s.T_base_laser.theta_rad, s.T_base_laser.x_m,
      s.T_base_laser.y_m, s.delay_s;
  return v;
}
[[nodiscard]] inline RobotNumbers to_setup(const Vector& v) {
  return {{v[kWheelLeft], v[kWheelRight], v[kTrack]}, {v[kPlaceX], v[kPlaceY], v[kYaw]}, v[kDelay]};
}

}  // namespace topo::calibration
