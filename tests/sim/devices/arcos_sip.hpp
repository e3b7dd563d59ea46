// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace topo::sim::arcos {

struct SonarReading {
  int index = 0;     ///< 0 to 31
  int range_mm = 0;  ///< 5000: no echo
};

/// The fields of a standard SIP in wire units (PROTOCOLS section 4), up to FAULTFLAGS as sent by ARCOS 2.
struct Sip {
  bool moving = false;
  int x_mm = 0;  ///< any integer: the packet contains 15 bits of it
  int y_mm = 0;
  int heading_counts = 0;  ///< 4096 per turn, -2048 to 2047
  int left_mm_s = 0;
  int right_mm_s = 0;
  int battery_dv = 0;  ///< 0.1 V
  int stall_bump = 0;
  int flags = 0;
  std::vector<SonarReading> sonar;
  int digin = 0xFF;
  int rotation_ddeg_s = 0;  ///< 0.1 deg/s
  int fault_flags = 0;
};

[[nodiscard]] std::string sip_packet(const Sip& sip);
[[nodiscard]] std::string encoder_packet(std::int32_t left_ticks, std::int32_t right_ticks);
/// Readings of the analog gyro: 512 and its drift at rest, less counter-clockwise.
[[nodiscard]] std::string gyro_packet(std::span<const int> readings, int temperature);
/// P3: four digital inputs (port, front and rear bumpers, infrared), one output, nine analog ports.
[[nodiscard]] std::string io_packet(int digin, int front_bumpers, int rear_bumpers, int digout);

}  // namespace topo::sim::arcos
