// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/devices/arcos_drive.hpp"

#include <algorithm>
#include <cmath>

#include "core/types/se2.hpp"

namespace topo::sim::arcos {
namespace {

/// One step of a ramp: accelerates with acc, slows down (also for a change of sign) with decel.
double ramp(double now, double target, double acc, double decel, double dt_s) {
  const bool slowing = now != 0.0 && (now > 0.0 ? target < now : target > now);
  const double most = (slowing ? decel : acc) * dt_s;
  double next = now + std::clamp(target - now, -most, most);
  if (slowing && next * now < 0.0) next = 0.0;  // through zero only with the deceleration
  return next;
}

/// Greatest speed from which `left` is still enough to brake: the square root of the way, and near the end
/// a line, so that the goal is reached without swinging.
double approach_speed(double left, double top, double decel) {
  constexpr double kPerSecond = 4.0;
  const double line = decel / (kPerSecond * kPerSecond);  // where the two have the same slope
  const double way = std::abs(left);
  const double speed = way < line ? kPerSecond * way : std::sqrt(2.0 * decel * (way - line / 2.0));
  return std::copysign(std::min(speed, top), left);
}

int in_range(int value, int top) { return std::clamp(std::abs(value), 1, top); }

}  // namespace

Drive::Drive(const Parameters& parameters) : flash_(parameters), working_(parameters) {}

void Drive::leave_wheels() {
  if (by_wheels_) velocity_setpoint_ = rotation_setpoint_ = 0.0;
  by_wheels_ = false;
}

void Drive::set_velocity(int mm_s) {
  if (emergency_) return;
  leave_wheels();
  way_goal_mm_.reset();
  velocity_setpoint_ = mm_s;
}

void Drive::set_rotation(int deg_s) {
  if (emergency_) return;
  leave_wheels();
  heading_goal_deg_.reset();
  rotation_setpoint_ = deg_s;
}

void Drive::set_wheels(int left_counts, int right_counts) {
  if (emergency_) return;
  way_goal_mm_.reset();
  heading_goal_deg_.reset();
  by_wheels_ = true;
  // The firmware recomposes VEL and RVEL and applies their limits (PROTOCOLS section 3).
  const double left = left_counts * kVel2Unit;
  const double right = right_counts * kVel2Unit;
  velocity_setpoint_ = (left + right) / 2.0;
  rotation_setpoint_ = (right - left) / working_.track_mm / topo::types::kDegree_rad;
}

void Drive::move(int mm, const Reckoning& at) {
  if (emergency_) return;
  leave_wheels();
  way_goal_mm_ = at.way_mm + mm;
}

void Drive::turn_to(double heading_deg) {
  if (emergency_) return;
  leave_wheels();
  heading_goal_deg_ = last_heading_goal_deg_ = heading_deg;
}

void Drive::turn_on(double deg, const Reckoning& at) {
  turn_to(last_heading_goal_deg_.value_or(at.heading_deg) + deg);
}

void Drive::origin_set(const Reckoning& before) {
  for (auto* goal : {&heading_goal_deg_, &last_heading_goal_deg_})
    if (*goal) **goal -= before.heading_deg;
}

void Drive::approach_goals(const Reckoning& at) {
  constexpr double kThere_mm = 0.5;
  // A Pioneer holds its heading after HEAD; the goal of MOVE is over when it is reached.
  if (heading_goal_deg_) {
    rotation_setpoint_ = approach_speed(std::remainder(*heading_goal_deg_ - at.heading_deg, 360.0),
                                        working_.rot_vel_max, working_.rot_decel);
  }
  if (!way_goal_mm_) return;
  const double left_mm = *way_goal_mm_ - at.way_mm;
  velocity_setpoint_ = approach_speed(left_mm, working_.trans_vel_max, working_.trans_decel);
  if (std::abs(left_mm) > kThere_mm) return;
  way_goal_mm_.reset();
  velocity_setpoint_ = 0.0;
}

void Drive::stop() {
  way_goal_mm_.reset();
  heading_goal_deg_.reset();
  by_wheels_ = false;
  velocity_setpoint_ = 0.0;
  rotation_setpoint_ = 0.0;
}

void Drive::emergency_stop() {
  stop();
  emergency_ = moving();
}

void Drive::set_max_velocity(int mm_s) { working_.trans_vel_max = in_range(mm_s, working_.trans_vel_top); }
void Drive::set_max_rotation(int deg_s) { working_.rot_vel_max = in_range(deg_s, working_.rot_vel_top); }

void Drive::set_acceleration(int mm_s2) {
  (mm_s2 < 0 ? working_.trans_decel : working_.trans_acc) = in_range(mm_s2, working_.trans_acc_top);
}

void Drive::set_rotation_acceleration(int deg_s2) {
  (deg_s2 < 0 ? working_.rot_decel : working_.rot_acc) = in_range(deg_s2, working_.rot_acc_top);
}

void Drive::revert() {
  working_ = flash_;
  stop();
  last_heading_goal_deg_.reset();
}

void Drive::stand() {
  velocity_mm_s_ = 0.0;
  rotation_deg_s_ = 0.0;
  emergency_ = false;
}

void Drive::blocked(double velocity_mm_s, double rotation_deg_s) {
  velocity_mm_s_ = velocity_mm_s;
  rotation_deg_s_ = rotation_deg_s;
}

WheelTargets Drive::step(double dt_s, bool hold, const Reckoning& at) {
  approach_goals(at);
  const double velocity_top = working_.trans_vel_max;
  const double rotation_top = working_.rot_vel_max;
  const double velocity_goal = hold ? 0.0 : std::clamp(velocity_setpoint_, -velocity_top, velocity_top);
  const double rotation_goal = hold ? 0.0 : std::clamp(rotation_setpoint_, -rotation_top, rotation_top);
  const double decel = emergency_ ? working_.trans_acc_top : working_.trans_decel;
  const double rot_decel = emergency_ ? working_.rot_acc_top : working_.rot_decel;
  velocity_mm_s_ = ramp(velocity_mm_s_, velocity_goal, working_.trans_acc, decel, dt_s);
  rotation_deg_s_ = ramp(rotation_deg_s_, rotation_goal, working_.rot_acc, rot_decel, dt_s);
  if (!moving()) emergency_ = false;
  const double turn_mm_s = rotation_deg_s_ * topo::types::kDegree_rad * working_.track_mm / 2.0;
  return {(velocity_mm_s_ - turn_mm_s) * 1e-3, (velocity_mm_s_ + turn_mm_s) * 1e-3};
}

}  // namespace topo::sim::arcos
