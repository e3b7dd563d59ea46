// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/sip.hpp"

#include <algorithm>

#include "core/types/bytes.hpp"
#include "drivers/pioneer/arcos_codec.hpp"

namespace topo::pioneer {
namespace {

constexpr unsigned kFlagStopButton = 1U << 5U;
constexpr unsigned kFlagChargerPower = 1U << 10U;
constexpr std::size_t kFixedPart = 20;  ///< type to sonar count

void read_fixed_part(types::ByteReader& in, StatusPacket& out) {
  out.x_counts = *in.optional<std::uint16_t>();
  out.y_counts = *in.optional<std::uint16_t>();
  out.heading_units = *in.optional<std::int16_t>();
  out.left_velocity = *in.optional<std::int16_t>();
  out.right_velocity = *in.optional<std::int16_t>();
  out.battery_decivolt = *in.optional<std::uint8_t>();
  out.stall_bump = *in.optional<std::uint16_t>();
  in.optional<std::uint16_t>();  // CONTROL: legacy
  out.flags = *in.optional<std::uint16_t>();
  in.optional<std::uint8_t>();  // COMPASS
}

bool read_sonar(types::ByteReader& in, StatusPacket& out) {
  const std::size_t count = *in.optional<std::uint8_t>();
  if (count > StatusPacket::kMaxEchoes || in.remaining() < count * 3) return false;
  out.echoes = count;
  for (std::size_t i = 0; i < count; ++i)
    out.echo[i] = {*in.optional<std::uint8_t>(), *in.optional<std::uint16_t>()};
  return true;
}

void read_optional_part(types::ByteReader& in, StatusPacket& out) {
  in.optional<std::uint8_t>();  // GRIP_STATE
  in.optional<std::uint8_t>();  // ANPORT
  in.optional<std::uint8_t>();  // ANALOG
  out.digital_in = in.optional<std::uint8_t>();
  out.digital_out = in.optional<std::uint8_t>();
  out.battery_x10 = in.optional<std::uint16_t>();
  out.charge_state = in.optional<std::uint8_t>();
  out.rotation_decidegps = in.optional<std::int16_t>();
  out.fault_flags = in.optional<std::uint16_t>();
  in.optional<std::uint16_t>();  // LATVEL
  out.temperature_c = in.optional<std::int8_t>();
  out.state_of_charge_percent = in.optional<std::uint8_t>();
}

float battery_v(const StatusPacket& p) {
  const unsigned decivolt = p.battery_x10.value_or(0) != 0 ? *p.battery_x10 : p.battery_decivolt;
  return static_cast<float>(decivolt) * 0.1F;
}

bool is_charging(const StatusPacket& p) {
  const unsigned state = p.charge_state.value_or(0);
  return (state >= 1 && state <= 4) || (p.flags & kFlagChargerPower) != 0;
}

float state_of_charge(const StatusPacket& p) {
  const unsigned percent = p.state_of_charge_percent.value_or(0);
  return percent == 0 || percent > 100 ? -1.0F : static_cast<float>(percent) * 0.01F;
}

}  // namespace

std::optional<StatusPacket> decode_status(std::span<const std::byte> payload) {
  if (payload.size() < kFixedPart) return std::nullopt;
  types::ByteReader in(payload);
  const auto type = static_cast<PacketType>(*in.optional<std::uint8_t>());
  if (type != PacketType::kStatusStopped && type != PacketType::kStatusMoving) return std::nullopt;
  StatusPacket out;
  out.moving = type == PacketType::kStatusMoving;
  read_fixed_part(in, out);
  if (!read_sonar(in, out)) return std::nullopt;
  read_optional_part(in, out);
  return out;
}

void apply_status(const StatusPacket& packet, const RobotModel& model, types::Stamp arrival,
                  types::BaseState& state) {
  const unsigned bits = packet.stall_bump;
  state.arrival = arrival;
  state.motors_enabled = packet.motors_enabled();
  state.stop_button = (packet.flags & kFlagStopButton) != 0;
  state.stall_left = (bits & 0x0001U) != 0;
  state.stall_right = (bits & 0x0100U) != 0;
  state.bumpers_rear = static_cast<std::uint8_t>((bits & 0x00FEU) >> 1U);
  state.bumpers_front = static_cast<std::uint8_t>(bits >> 9U);
  state.battery_v = battery_v(packet);
  state.state_of_charge = state_of_charge(packet);
  state.charging = is_charging(packet);
  for (std::size_t i = 0; i < std::min(packet.echoes, packet.echo.size()); ++i) {
    const SonarEcho& echo = packet.echo[i];
    if (echo.index >= types::BaseState::kMaxSonars) continue;
    const double range_m = echo.range_units * model.mm_per_sonar_unit * 1e-3;
    state.sonar[echo.index] = {arrival, static_cast<float>(range_m)};
  }
}

types::Twist2 measured_twist(const StatusPacket& packet, const RobotModel& model) {
  const double left_mmps = packet.left_velocity * model.mmps_per_velocity_unit;
  const double right_mmps = packet.right_velocity * model.mmps_per_velocity_unit;
  return {0.5e-3 * (left_mmps + right_mmps), 0.5 * (right_mmps - left_mmps) * model.radps_per_mmps};
}

}  // namespace topo::pioneer
