// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/devices/arcos_model.hpp"

#include <array>

#include "tests/sim/devices/arcos_packet.hpp"

namespace topo::sim::arcos {

Parameters p3dx_parameters() {
  Parameters p{};
  p.subclass = "p3dx-sh";
  p.robot_name = "simbot";
  p.serial = "SB0123";
  p.track_mm = 2.0 / 0.0056;
  p.ticks_per_mm = 132;
  p.rev_count = 16570;
  p.front_bumpers = 5;
  p.rear_bumpers = 5;
  return p;
}

Parameters p3at_parameters() {
  Parameters p = p3dx_parameters();
  p.subclass = "p3at-sh";
  p.serial = "SA0456";
  p.track_mm = 2.0 / 0.0034;
  p.four_motors = true;
  p.has_gyro = true;
  p.ticks_per_mm = 170;
  p.rev_count = 32550;
  return p;
}

unsigned baud_of_code(int code) {
  constexpr std::array<unsigned, 5> kRates{9600, 19200, 38400, 57600, 115200};
  return code >= 0 && code < static_cast<int>(kRates.size()) ? kRates[static_cast<std::size_t>(code)] : 0;
}

std::string config_packet(const Parameters& p, int baud_code) {
  PacketBuilder b(0x20);
  b.text("Pioneer").text(p.subclass).text(p.serial).u8(p.four_motors ? 1 : 0);
  b.u16(p.rot_vel_top).u16(p.trans_vel_top).u16(p.rot_acc_top).u16(p.trans_acc_top).u16(500);
  b.text(p.robot_name).u8(p.sip_cycle_ms).u8(baud_code).u8(0);
  b.u16(0).u16(1).u8(1);                                 // gripper, front sonar, rear sonar
  b.u16(110).u16(p.rev_count).u16(p.watchdog_ms).u8(0);  // low battery, ..., P2Mpacs
  b.u16(200).u16(100).u16(500).u16(50);                  // stall value and count, joystick speeds
  b.u16(p.rot_vel_max).u16(p.trans_vel_max);
  b.u16(p.rot_acc).u16(p.rot_decel).u16(40).u16(20).u16(0);      // rotation Kp Kv Ki
  b.u16(p.trans_acc).u16(p.trans_decel).u16(40).u16(30).u16(0);  // translation Kp Kv Ki
  b.u8(p.front_bumpers).u8(p.rear_bumpers).u8(0).u8(p.sonar_cycle_ms).u8(p.auto_baud);  // charger
  b.u8(p.has_gyro ? 1 : 0);
  b.u16(0).u8(0).u8(0).u16(p.ticks_per_mm).u16(105);  // drift factor, AUX rates, ShutdownVolts
  b.text("2.9").u16(0).u16(0).u8(0);                  // firmware, gyro scales, kinematics delay
  return b.frame();
}

}  // namespace topo::sim::arcos
