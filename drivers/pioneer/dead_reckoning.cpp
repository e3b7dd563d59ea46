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

void DeadReckoning::restart(const RobotModel& model, double v_max_mps, double omega_max_radps,
                            const types::WheelCalibration& wheels) {
  model_ = model;
  wheels_ = wheels;
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

bool DeadReckoning::stands(const StatusPacket& packet) const {
  return initialised_ && packet.x_counts == last_.x && packet.y_counts == last_.y &&
         packet.heading_units == last_.heading && packet.left_velocity == 0 && packet.right_velocity == 0;
}

/// A calibrated robot, or one with a gyro, goes another way than its firmware reckons: along an arc with the
/// way of its wheels.
void DeadReckoning::move(double dx_m, double dy_m, double turn_rad, std::optional<double> gyro_turn_rad) {
  const double heading_rad = last_.heading * radians_per_heading_unit() + 0.5 * turn_rad;
  const double way_m = dx_m * std::cos(heading_rad) + dy_m * std::sin(heading_rad);
  const types::Progress by_wheels =
      types::true_progress(wheels_, 2e-3 / model_.radps_per_mmps, {way_m, turn_rad});
  const double turned_rad = gyro_turn_rad.value_or(by_wheels.turn_rad);
  pose_ = pose_ * types::Se2{by_wheels.way_m * std::cos(0.5 * turned_rad),
                             by_wheels.way_m * std::sin(0.5 * turned_rad), turned_rad};
}

DeadReckoning::Update DeadReckoning::update(const StatusPacket& packet, types::Duration elapsed,
                                            std::optional<double> gyro_turn_rad) {
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
  if (gyro_turn_rad || wheels_ != types::WheelCalibration{}) {
    move(dx_m, dy_m, turn_rad, gyro_turn_rad);
    initialise(now);
    return Update::kMoved;
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
