// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/calibrate/calibration_error.hpp"

#include <algorithm>
#include <cmath>

namespace topo::bench {
namespace {

double in_degrees(double angle_rad) { return std::abs(types::wrap_angle(angle_rad)) / types::kDegree_rad; }
double in_percent(double found, double truth) { return 100.0 * std::abs(found / truth - 1.0); }

}  // namespace

Errors errors_of(const CalibratedRobot& robot) {
  const daemon::BaseConfig& base = robot.configuration.base;
  const daemon::ScannerConfig& front = robot.configuration.front;
  const daemon::ScannerConfig& coronal = robot.configuration.coronal;
  const TrueRobot& truth = robot.truth;
  const types::Se2& at = truth.T_base_laser;
  const walls::CoronalMount& upright = truth.coronal;
  const Eigen::Vector3d aside{coronal.x_m - upright.x_m, coronal.y_m - upright.y_m,
                              coronal.z_m - upright.z_m};
  return {in_degrees(front.yaw_rad - at.theta_rad),
          1e3 * std::hypot(front.x_m - at.x_m, front.y_m - at.y_m),
          std::max(in_percent(base.wheels.left, robot.true_wheels.left),
                   in_percent(base.wheels.right, robot.true_wheels.right)),
          in_percent(base.wheels.track_m, robot.true_wheels.track_m),
          1e3 * std::abs(base.status_delay_s - truth.delay_s),
          in_degrees(coronal.roll_rad - upright.roll_rad),
          1e3 * aside.norm()};
}

}  // namespace topo::bench
