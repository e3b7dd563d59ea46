// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/dead_reckoning.hpp"

#include <cmath>

namespace topo::pioneer {
namespace {

constexpr int kPositionModulus = 1 << 15;  ///< 15 bits; the sixteenth is ignored
constexpr double kJumpFactor = 1.5;
constexpr double kJumpSlack_m = 0.02;  ///< quantisation and the jitter of the cycle
constexpr double kJumpSlack_rad = 0.05;

}  // namespace

int counter_difference(int now, int before, int modulus) {
  const int half = modulus / 2;
  const int raw = (now - before) % modulus;  // in (-modulus, modulus)
  return (raw + half + modulus) % modulus - half;
}

void DeadReckoning::restart(const RobotModel& model, double v_max_mps, double omega_max_radps) {
  model_ = model;
  v_max_mps_ = v_max_mps;
  omega_max_radps_ = omega_max_radps;
  initialised_ = false;
}

bool DeadReckoning::possible(double distance_m, double turn_rad, types::Duration elapsed) const {
  const double seconds = types::to_seconds(elapsed);
  return distance_m <= kJumpFactor * v_max_mps_ * seconds + kJumpSlack_m &&
         std::abs(turn_rad) <= kJumpFactor * omega_max_radps_ * seconds + kJumpSlack_rad;
}

void DeadReckoning::initialise(const Counts& counts) {
  last_ = counts;
  T_odom_robot_theta_rad_ = types::wrap_angle(pose_.theta_rad - counts.heading * radians_per_heading_unit());
  initialised_ = true;
}

DeadReckoning::Update DeadReckoning::update(const StatusPacket& packet, types::Duration elapsed) {
  const Counts now{packet.x_counts, packet.y_counts, packet.heading_units};
  if (!initialised_) {
    initialise(now);
    return Update::kInitialised;
  }
  const double to_m = model_.mm_per_count * 1e-3;
  const double dx_m = counter_difference(now.x, last_.x, kPositionModulus) * to_m;
  const double dy_m = counter_difference(now.y, last_.y, kPositionModulus) * to_m;
  const double turn_rad =
      counter_difference(now.heading, last_.heading, kHeadingUnits) * radians_per_heading_unit();
  if (!possible(std::hypot(dx_m, dy_m), turn_rad, elapsed)) {
    initialise(now);
    return Update::kJumped;
  }
  const types::Vector2 step = types::Se2{0.0, 0.0, T_odom_robot_theta_rad_} * types::Vector2{dx_m, dy_m};
  pose_.x_m += step.x();
  pose_.y_m += step.y();
  // From the counter itself instead of a sum of differences: no rounding error accumulates over hours.
  pose_.theta_rad = types::wrap_angle(T_odom_robot_theta_rad_ + now.heading * radians_per_heading_unit());
  last_ = now;
  return Update::kMoved;
}

}  // namespace topo::pioneer
