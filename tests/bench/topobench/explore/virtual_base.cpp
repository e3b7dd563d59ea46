// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/virtual_base.hpp"

#include <cmath>
#include <utility>

#include "drivers/pioneer/setpoints.hpp"

namespace topo::bench {
namespace {

constexpr float kBattery_v = 12.7F;
constexpr double kStands_mps = 0.005;  // as the driver's session has it
constexpr double kStands_radps = 0.01;

int whole(double value) { return static_cast<int>(value); }

}  // namespace

VirtualBase::VirtualBase(const types::RobotLimits& limits, types::Duration watchdog,
                         const sim::arcos::Parameters& firmware, const types::WheelCalibration& wheels)
    : drive_(firmware),
      wheels_(wheels),
      v_max_mps_(limits.v_max_mps),
      omega_max_radps_(limits.omega_max_radps),
      watchdog_(watchdog) {
  drive_.set_max_velocity(whole(limits.v_max_mps * 1e3));
  drive_.set_max_rotation(whole(limits.omega_max_radps / types::kDegree_rad));
  drive_.set_acceleration(whole(limits.acceleration_mps2 * 1e3));
  drive_.set_acceleration(-whole(limits.deceleration_mps2 * 1e3));
  drive_.set_rotation_acceleration(whole(limits.angular_acceleration_radps2 / types::kDegree_rad));
  drive_.set_rotation_acceleration(-whole(limits.angular_acceleration_radps2 / types::kDegree_rad));
}

/// What the firmware must be given, which reckons with the model's wheels.
types::Twist2 VirtualBase::counted(const types::Twist2& wanted) const {
  if (wheels_ == types::WheelCalibration{}) return wanted;
  const types::Progress p =
      types::counted_progress(wheels_, sim::RobotModel::p3dx().track_m, {wanted.v_mps, wanted.omega_radps});
  return {p.way_m, p.turn_rad};
}

void VirtualBase::command(const types::BaseCommand& command, sim::SimTime now) {
  if (command
          .silence) {  // one E_STOP, as the driver sends a few, and then nothing (drivers/pioneer/drive.cpp)
    if (!std::exchange(silent_, true)) drive_.emergency_stop();
    return;
  }
  silent_ = false;
  last_command_ = now;
  want_motors_ = command.enable_motors;
  if (command.estop) {
    drive_.emergency_stop();
    return;
  }
  const bool moves = want_motors_ && motors_on_;
  const auto setpoints =
      moves ? pioneer::quantise(counted(command.twist), v_max_mps_, omega_max_radps_) : pioneer::Setpoints{};
  drive_.set_velocity(setpoints.v_mmps);
  drive_.set_rotation(setpoints.omega_degps);
}

sim::WheelSpeeds VirtualBase::wheel_speeds(sim::SimTime now, sim::SimTime dt, const sim::RobotBody& body) {
  if (body.contact().stall_left || body.contact().stall_right) drive_.blocked(0.0, 0.0);
  if (!motors_on_) {
    drive_.stand();
    return {};
  }
  const auto wheels =
      drive_.step(types::to_seconds(dt), now - last_command_ > watchdog_, {});  // no MOVE, no HEAD
  return {wheels.left_mps, wheels.right_mps};
}

void VirtualBase::on_sonar(const sim::SonarEcho& echo) {
  const auto i = static_cast<std::size_t>(echo.index);
  sonar_[i].range_m = static_cast<float>(std::floor(echo.range_m * 1e3) * 1e-3);
  heard_[i] = true;
}

types::BaseState VirtualBase::status(const types::Odometry& odometry, types::Stamp arrival,
                                     const sim::RobotBody& body) {
  const sim::Contact& contact = body.contact();
  types::BaseState state;
  state.odometry = odometry;
  state.arrival = arrival;
  state.sequence = ++sequence_;
  state.motors_enabled = motors_on_;
  state.stall_left = contact.stall_left;
  state.stall_right = contact.stall_right;
  state.bumpers_front = contact.bumpers_front;
  state.bumpers_rear = contact.bumpers_rear;
  state.battery_v = kBattery_v;
  for (std::size_t i = 0; i < sonar_.size(); ++i) {
    if (heard_[i]) sonar_[i].stamp = arrival;
    heard_[i] = false;
  }
  state.sonar = sonar_;
  switch_motors(odometry.twist);
  return state;
}

// Motors go off only at a standstill, because a robot without motors does not brake
// (drivers/pioneer/drive.cpp).
void VirtualBase::switch_motors(const types::Twist2& twist) {
  const bool stands = std::abs(twist.v_mps) < kStands_mps && std::abs(twist.omega_radps) < kStands_radps;
  if (want_motors_ || stands) motors_on_ = want_motors_;
}

}  // namespace topo::bench
