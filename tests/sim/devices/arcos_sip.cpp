// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/devices/arcos_sip.hpp"

#include <algorithm>

#include "tests/sim/devices/arcos_packet.hpp"

namespace topo::sim::arcos {

std::string sip_packet(const Sip& sip) {
  constexpr int kWrap = 0x7FFF;
  constexpr int kBatteryByteMost = 255;
  PacketBuilder b(sip.moving ? 0x33 : 0x32);
  b.u16(sip.x_mm & kWrap).u16(sip.y_mm & kWrap).u16(sip.heading_counts);
  b.u16(sip.left_mm_s).u16(sip.right_mm_s).u8(std::min(sip.battery_dv, kBatteryByteMost));
  b.u16(sip.stall_bump).u16(0).u16(sip.flags).u8(0);
  b.u8(static_cast<int>(sip.sonar.size()));
  for (const SonarReading& reading : sip.sonar) b.u8(reading.index).u16(reading.range_mm);
  b.u8(0).u8(0).u8(0).u8(sip.digin).u8(0);
  b.u16(sip.battery_dv).u8(0).u16(sip.rotation_ddeg_s).u16(sip.fault_flags);
  return b.frame();
}

std::string encoder_packet(std::int32_t left_ticks, std::int32_t right_ticks) {
  return PacketBuilder(0x90).i32(left_ticks).i32(right_ticks).frame();
}

std::string gyro_packet(std::span<const int> readings, int temperature) {
  PacketBuilder b(0x98);
  b.u8(static_cast<int>(readings.size()));
  for (const int reading : readings) b.u16(reading).u8(temperature);
  return b.frame();
}

std::string io_packet(int digin, int front_bumpers, int rear_bumpers, int digout) {
  constexpr int kAnalogPorts = 9;
  PacketBuilder b(0xF0);
  b.u8(4).u8(digin).u8(front_bumpers).u8(rear_bumpers).u8(0);
  b.u8(1).u8(digout).u8(kAnalogPorts);
  for (int i = 0; i < kAnalogPorts; ++i) b.u16(0);
  return b.frame();
}

}  // namespace topo::sim::arcos
