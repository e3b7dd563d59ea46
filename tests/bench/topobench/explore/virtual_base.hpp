// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "core/types/base_state.hpp"
#include "core/types/robot_limits.hpp"
#include "core/types/wheel_calibration.hpp"
#include "tests/sim/devices/arcos_drive.hpp"
#include "tests/sim/simulation.hpp"

namespace topo::bench {

/// A Pioneer's firmware with the driver's session in front of it, as values instead of bytes: setpoints in
/// whole mm/s and deg/s, the firmware's ramps and watchdog, the motors' switch, and what a status packet
/// says. Not thread-safe.
class VirtualBase final : public sim::WheelDrive {
 public:
  /// `wheels`: as the driver is told that they are.
  VirtualBase(const types::RobotLimits& limits, types::Duration watchdog,
              const sim::arcos::Parameters& firmware = sim::arcos::p3dx_parameters(),
              const types::WheelCalibration& wheels = {});

  /// Bytes that the firmware does not obey feed its watchdog all the same.
  void feed_watchdog(sim::SimTime now) { last_command_ = now; }

  /// What the base thread sends once a period.
  void command(const types::BaseCommand& command, sim::SimTime now);

  sim::WheelSpeeds wheel_speeds(sim::SimTime now, sim::SimTime dt, const sim::RobotBody& body) override;

  /// Goes into the next status packet.
  void on_sonar(const sim::SonarEcho& echo);

  /// A status packet, which arrives at `arrival`; the driver switches the motors when it reads it.
  types::BaseState status(const types::Odometry& odometry, types::Stamp arrival, const sim::RobotBody& body);

 private:
  void switch_motors(const types::Twist2& twist);
  [[nodiscard]] types::Twist2 counted(const types::Twist2& wanted) const;

  sim::arcos::Drive drive_;
  types::WheelCalibration wheels_;
  double v_max_mps_, omega_max_radps_;
  sim::SimTime watchdog_;
  sim::SimTime last_command_{0};
  bool silent_ = false;
  bool motors_on_ = false;
  bool want_motors_ = false;
  std::uint64_t sequence_ = 0;
  std::array<types::SonarReading, types::BaseState::kMaxSonars> sonar_{};
  std::array<bool, types::BaseState::kMaxSonars> heard_{};
};

}  // namespace topo::bench
