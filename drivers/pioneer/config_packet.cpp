// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/config_packet.hpp"

#include "drivers/pioneer/arcos_codec.hpp"
#include "drivers/pioneer/byte_reader.hpp"

namespace topo::pioneer {
namespace {

int byte(ByteReader& in) { return in.u8().value_or(0); }
int word(ByteReader& in) { return in.u16().value_or(0); }
void skip_words(ByteReader& in, int count) {
  for (int i = 0; i < count; ++i) in.u16();
}

void read_identity(ByteReader& in, ConfigPacket& out) {
  out.robot_class = in.text();
  out.subclass = in.text();
  out.serial_number = in.text();
  in.u8();  // four-motors flag
  out.rot_velocity_top_degps = word(in);
  out.velocity_top_mmps = word(in);
  out.rot_acceleration_top_degps2 = word(in);
  out.acceleration_top_mmps2 = word(in);
  in.u16();  // PwmMax
  out.name = in.text();
}

void read_equipment(ByteReader& in, ConfigPacket& out) {
  out.sip_cycle_ms = byte(in);
  out.host_baud_code = byte(in);
  in.u8();   // Aux1Baud
  in.u16();  // HasGripper
  out.front_sonar = word(in);
  out.rear_sonar = byte(in);
  out.low_battery_decivolt = word(in);
  in.u16();  // RevCount
  out.watchdog_ms = word(in);
  in.u8();             // P2Mpacs
  skip_words(in, 16);  // StallVal to TransKi: working values and PID
}

void read_later_fields(ByteReader& in, ConfigPacket& out) {
  out.front_bumps = byte(in);
  out.rear_bumps = byte(in);
  in.u8();  // Charger
  in.u8();  // SonarCycle
  out.auto_baud = byte(in);
  in.u8();   // HasGyro
  in.i16();  // DriftFactor
  in.u8();   // Aux2Baud
  in.u8();   // Aux3Baud
  out.ticks_per_mm = word(in);
  out.shutdown_decivolt = word(in);
  out.firmware = in.text();
}

}  // namespace

std::optional<ConfigPacket> decode_config(std::span<const std::byte> payload) {
  ByteReader in(payload);
  if (in.u8() != static_cast<std::uint8_t>(PacketType::kConfig)) return std::nullopt;
  ConfigPacket out;
  read_identity(in, out);
  if (in.remaining() == 0) return std::nullopt;
  read_equipment(in, out);
  read_later_fields(in, out);
  return out;
}

}  // namespace topo::pioneer
