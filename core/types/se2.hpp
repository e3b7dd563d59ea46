// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

namespace topo::types {

using Vector2 = Eigen::Vector2d;

inline constexpr double kDegree_rad = std::numbers::pi / 180.0;

/// The same angle in (-pi, pi].
inline double wrap_angle(double angle_rad) {
  constexpr double kPi = std::numbers::pi, kTwoPi = 2.0 * kPi;
  // Nearly all inputs are sums of two wrapped angles; in that range one addition is as exact as the
  // remainder.
  if (std::abs(angle_rad) <= kTwoPi) {
    if (angle_rad > kPi) return angle_rad - kTwoPi;
    return angle_rad <= -kPi ? angle_rad + kTwoPi : angle_rad;
  }
  const double wrapped = std::remainder(angle_rad, kTwoPi);
  return wrapped <= -kPi ? wrapped + kTwoPi : wrapped;
}

/// An angle less the nearest whole number of quarter turns, in [-pi/4, pi/4]: directions of walls are the
/// same after a quarter turn.
inline double within_quarter(double angle_rad) { return std::remainder(angle_rad, 0.5 * std::numbers::pi); }

/// Element of SE(2) without frame types, for kernels and files. Applies the rotation first, then the
/// translation.
struct Se2 {
  double x_m = 0.0;
  double y_m = 0.0;
  double theta_rad = 0.0;  ///< counter-clockwise

  [[nodiscard]] Vector2 translation() const { return {x_m, y_m}; }

  [[nodiscard]] Se2 operator*(const Se2& b) const {
    const double c = std::cos(theta_rad), s = std::sin(theta_rad);
    return {x_m + c * b.x_m - s * b.y_m, y_m + s * b.x_m + c * b.y_m, wrap_angle(theta_rad + b.theta_rad)};
  }
  [[nodiscard]] Vector2 operator*(const Vector2& p) const {
    const double c = std::cos(theta_rad), s = std::sin(theta_rad);
    return {x_m + c * p.x() - s * p.y(), y_m + s * p.x() + c * p.y()};
  }
  [[nodiscard]] Se2 inverse() const {
    const double c = std::cos(theta_rad), s = std::sin(theta_rad);
    return {-c * x_m - s * y_m, s * x_m - c * y_m, wrap_angle(-theta_rad)};
  }
  friend bool operator==(const Se2&, const Se2&) = default;
};

/// Distance between the two positions; the headings are ignored.
inline double distance_m(const Se2& a, const Se2& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

/// Are two poses further apart than `apart_m`, or turned against each other by more than `apart_rad`?
inline bool is_apart(const Se2& a, const Se2& b, double apart_m, double apart_rad) {
  return distance_m(a, b) > apart_m || std::abs(wrap_angle(b.theta_rad - a.theta_rad)) > apart_rad;
}

/// Pose between a (t = 0) and b (t = 1): constant rate in rotation, straight line in translation. The
/// deviation from the arc is below 1 mm over a scan of 50 ms at 1.5 m/s and 2 rad/s.
inline Se2 interpolate(const Se2& a, const Se2& b, double t) {
  return {a.x_m + t * (b.x_m - a.x_m), a.y_m + t * (b.y_m - a.y_m),
          wrap_angle(a.theta_rad + t * wrap_angle(b.theta_rad - a.theta_rad))};
}

}  // namespace topo::types
