// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/types/se2.hpp"

namespace topo::types {

// Frames of REP-105. They are tags: no object of them exists.
struct Map;
struct Odom;
struct Base;
struct LaserFront;
struct LaserCoronal;

/// T_A_B: maps coordinates of frame B into frame A, and is the pose of B in A. The inner frames of a product
/// must match, as in T_map_odom * T_odom_base; other products do not compile.
template <class A, class B>
class Transform2 {
 public:
  Transform2() = default;
  explicit Transform2(const Se2& se2) : se2_(se2) {}
  Transform2(double x_m, double y_m, double theta_rad) : se2_{x_m, y_m, theta_rad} {}

  [[nodiscard]] const Se2& se2() const { return se2_; }
  [[nodiscard]] double x_m() const { return se2_.x_m; }
  [[nodiscard]] double y_m() const { return se2_.y_m; }
  [[nodiscard]] double theta_rad() const { return se2_.theta_rad; }
  [[nodiscard]] Transform2<B, A> inverse() const { return Transform2<B, A>(se2_.inverse()); }

  template <class C>
  [[nodiscard]] Transform2<A, C> operator*(const Transform2<B, C>& b) const {
    return Transform2<A, C>(se2_ * b.se2());
  }
  friend bool operator==(const Transform2&, const Transform2&) = default;

 private:
  Se2 se2_;
};

/// Velocity of base_link in its own frame; a Pioneer has no sideways motion.
struct Twist2 {
  double v_mps = 0.0;        ///< forward
  double omega_radps = 0.0;  ///< counter-clockwise
  friend bool operator==(const Twist2&, const Twist2&) = default;
};

}  // namespace topo::types
