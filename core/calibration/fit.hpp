// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/calibration/closed_form.hpp"

namespace topo::calibration {

/// What is left of one interval's motion of the scanner (x, y, theta: seen less predicted by the wheels), and
/// how the prediction depends on the numbers of the robot.
struct Residual {
  std::size_t interval = 0;
  Eigen::Vector3d left_over = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 3, kNumbers> slope = Eigen::Matrix<double, 3, kNumbers>::Zero();
  bool used = true;  ///< false: contradicts the others, a wheel slipped
};

/// Standard deviations of one interval, from the spread of what is left.
struct Spread {
  double place_m = 0.0, turn_rad = 0.0;
};

/// By the medians, so that what contradicts the rest does not count.
[[nodiscard]] Spread spread_of(std::span<const Residual> residuals, const FitParams& params);

struct Fit {
  RobotNumbers numbers;
  Matrix covariance = Matrix::Zero();
  Spread spread;
  std::vector<Residual> residuals;        ///< at these numbers, of all intervals that the wheels cover
  [[nodiscard]] double left_out() const;  ///< share of them that is not used
};

/// The numbers that fit the intervals best, and how well they are known: the closed form, at the delay at
/// which turning fits best, refined by Gauss-Newton over all numbers together; intervals that contradict the
/// rest are left out (as Censi et al., section VI). The covariance is that of the least squares, scaled by
/// what is left, and by `overlap`, because overlapping intervals have their errors in common. Nothing when
/// the intervals leave a number open.
[[nodiscard]] std::optional<Fit> fit(const WheelTrack& wheels, std::span<const Interval> intervals,
                                     double overlap, const FitParams& params);

}  // namespace topo::calibration
