// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/way_point_drive.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace topo::sim {

namespace {

double towards(double value, double target, double most) {
  return value + std::clamp(target - value, -most, most);
}

}  // namespace

WayPointDrive::WayPointDrive(std::vector<Vector2> points, int laps, const Limits& limits)
    : points_(std::move(points)),
      laps_left_(laps),
      for_ever_(laps == 0),
      limits_(limits),
      finished_(points_.empty()) {}

WheelSpeeds WayPointDrive::wheel_speeds(SimTime /*now*/, SimTime dt, const RobotBody& body) {
  const double dt_s = types::to_seconds(dt);
  double v = 0.0;
  double omega = 0.0;
  if (!finished_) {
    const Vector2 rest = points_[next_] - body.truth().translation();
    const double off = types::wrap_angle(std::atan2(rest.y(), rest.x()) - body.truth().theta_rad);
    // Slow enough before the point to turn there.
    v = std::min(limits_.v_max_mps, std::sqrt(2.0 * limits_.acceleration_mps2 * rest.norm()));
    v *= std::clamp(1.0 - std::abs(off) / 0.6, 0.0, 1.0);
    omega = std::clamp(2.0 * off, -limits_.omega_max_radps, limits_.omega_max_radps);
    if (rest.norm() < limits_.arrived_m && ++next_ == points_.size()) {
      next_ = 0;
      finished_ = !for_ever_ && --laps_left_ <= 0;
    }
  }
  v_mps_ = towards(v_mps_, v, limits_.acceleration_mps2 * dt_s);
  omega_radps_ = towards(omega_radps_, omega, limits_.angular_acceleration_radps2 * dt_s);
  const double half_m = 0.5 * body.model().track_m;
  return {v_mps_ - half_m * omega_radps_, v_mps_ + half_m * omega_radps_};
}

void DeadReckoning::update(const RobotBody& body) {
  const double left = body.encoder_left_m() - left_m_;
  const double right = body.encoder_right_m() - right_m_;
  left_m_ = body.encoder_left_m();
  right_m_ = body.encoder_right_m();
  const double turn = (right - left) / track_m_;
  const double way = 0.5 * (left + right);
  pose_ = pose_ * Se2{way * std::cos(0.5 * turn), way * std::sin(0.5 * turn), turn};
}

}  // namespace topo::sim
