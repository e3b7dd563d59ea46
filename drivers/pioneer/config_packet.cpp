// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/config_packet.hpp"

#include "core/types/bytes.hpp"
#include "drivers/pioneer/arcos_codec.hpp"

namespace topo::pioneer {
namespace {

int byte(types::ByteReader& in) { return in.optional<std::uint8_t>().value_or(0); }
int word(types::ByteReader& in) { return in.optional<std::uint16_t>().value_or(0); }
void skip_words(types::ByteReader& in, int count) {
  for (int i = 0; i < count; ++i) in.optional<std::uint16_t>();
}

void read_identity(types::ByteReader& in, ConfigPacket& out) {
  out.robot_class = in.text();
  out.subclass = in.text();
  out.serial_number = in.text();
  in.optional<std::uint8_t>();  // four-motors flag
  out.rot_velocity_top_degps = word(in);
  out.velocity_top_mmps = word(in);
  out.rot_acceleration_top_degps2 = word(in);
  out.acceleration_top_mmps2 = word(in);
  in.optional<std::uint16_t>();  // PwmMax
  out.name = in.text();
}

void read_equipment(types::ByteReader& in, ConfigPacket& out) {
  out.sip_cycle_ms = byte(in);
  out.host_baud_code = byte(in);
  in.optional<std::uint8_t>();   // Aux1Baud
  in.optional<std::uint16_t>();  // HasGripper
  in.optional<std::uint16_t>();  // FrontSonar
  in.optional<std::uint8_t>();   // RearSonar
  out.low_battery_decivolt = word(in);
  in.optional<std::uint16_t>();  // RevCount
  out.watchdog_ms = word(in);
  in.optional<std::uint8_t>();  // P2Mpacs
  skip_words(in, 16);           // StallVal to TransKi: working values and PID
}

void read_later_fields(types::ByteReader& in, ConfigPacket& out) {
  out.front_bumps = byte(in);
  out.rear_bumps = byte(in);
  in.optional<std::uint8_t>();  // Charger
  in.optional<std::uint8_t>();  // SonarCycle
  out.auto_baud = byte(in);
  out.has_gyro = byte(in);
  in.optional<std::int16_t>();  // DriftFactor
  in.optional<std::uint8_t>();  // Aux2Baud
  in.optional<std::uint8_t>();  // Aux3Baud
  out.ticks_per_mm = word(in);
  out.shutdown_decivolt = word(in);
  out.firmware = in.text();
}

}  // namespace

std::optional<ConfigPacket> decode_config(std::span<const std::byte> payload) {
  types::ByteReader in(payload);
  if (in.optional<std::uint8_t>() != static_cast<std::uint8_t>(PacketType::kConfig)) return std::nullopt;
  ConfigPacket out;
  read_identity(in, out);
  if (in.remaining() == 0) return std::nullopt;
  read_equipment(in, out);
  read_later_fields(in, out);
  return out;
}

}  // namespace topo::pioneer
