// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace topo::sim::arcos {

/// Parameters of a robot's firmware, as in FLASH and CONFIGpac (PROTOCOLS sections 5 and 6).
struct Parameters {
  std::string subclass;  ///< p3dx-sh or p3at-sh
  std::string robot_name;
  std::string serial;
  double track_mm;  ///< 2 / DiffConvFactor: the effective track
  bool four_motors = false;
  int ticks_per_mm;  ///< TicksMM
  int rev_count;
  int front_bumpers;
  int rear_bumpers;
  int trans_vel_top = 1500;  ///< mm/s
  int rot_vel_top = 360;     ///< deg/s
  int trans_acc_top = 2000;  ///< mm/s^2
  int rot_acc_top = 300;     ///< deg/s^2
  int trans_vel_max = 750;
  int rot_vel_max = 100;
  int trans_acc = 300;
  int trans_decel = 300;
  int rot_acc = 100;
  int rot_decel = 100;
  int sip_cycle_ms = 100;
  int sonar_cycle_ms = 40;
  int watchdog_ms = 2000;
  int host_baud_code = 0;  ///< 9600
  int auto_baud = 2;       ///< the rate reverts when the session closes
  double battery_volts = 12.7;
  bool has_gyro = false;
};

inline constexpr int kVel2Unit = 20;  ///< mm/s per count of VEL2

[[nodiscard]] Parameters p3dx_parameters();
[[nodiscard]] Parameters p3at_parameters();

/// Bit/s of a rate code 0 to 4; 0 for any other.
[[nodiscard]] unsigned baud_of_code(int code);

/// The CONFIGpac as sent over the wire; baud_code is the present rate.
[[nodiscard]] std::string config_packet(const Parameters& parameters, int baud_code);

}  // namespace topo::sim::arcos
