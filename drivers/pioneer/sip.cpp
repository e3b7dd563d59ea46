// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/sip.hpp"

#include <algorithm>

#include "drivers/pioneer/arcos_codec.hpp"
#include "drivers/pioneer/byte_reader.hpp"

namespace topo::pioneer {
namespace {

constexpr unsigned kFlagMotors = 1U << 0U;
constexpr unsigned kFlagStopButton = 1U << 5U;
constexpr unsigned kFlagChargerPower = 1U << 10U;
constexpr std::size_t kFixedPart = 20;  ///< type to sonar count

void read_fixed_part(ByteReader& in, StatusPacket& out) {
  out.x_counts = *in.u16();
  out.y_counts = *in.u16();
  out.heading_units = *in.i16();
  out.left_velocity = *in.i16();
  out.right_velocity = *in.i16();
  out.battery_decivolt = *in.u8();
  out.stall_bump = *in.u16();
  in.u16();  // CONTROL: legacy
  out.flags = *in.u16();
  in.u8();  // COMPASS
}

bool read_sonar(ByteReader& in, StatusPacket& out) {
  const std::size_t count = *in.u8();
  if (count > StatusPacket::kMaxEchoes || in.remaining() < count * 3) return false;
  out.echoes = count;
  for (std::size_t i = 0; i < count; ++i) out.echo[i] = {*in.u8(), *in.u16()};
  return true;
}

void read_optional_part(ByteReader& in, StatusPacket& out) {
  in.u8();  // GRIP_STATE
  in.u8();  // ANPORT
  in.u8();  // ANALOG
  out.digital_in = in.u8();
  out.digital_out = in.u8();
  out.battery_x10 = in.u16();
  out.charge_state = in.u8();
  out.rotation_decidegps = in.i16();
  out.fault_flags = in.u16();
  in.u16();  // LATVEL
  out.temperature_c = in.i8();
  out.state_of_charge_percent = in.u8();
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
  ByteReader in(payload);
  const auto type = static_cast<PacketType>(*in.u8());
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
  state.motors_enabled = (packet.flags & kFlagMotors) != 0;
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
