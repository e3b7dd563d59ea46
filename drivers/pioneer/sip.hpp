// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/types/base_state.hpp"
#include "drivers/pioneer/robot_models.hpp"

namespace topo::pioneer {

struct SonarEcho {
  std::uint8_t index = 0;
  std::uint16_t range_units = 0;
};

/// The standard status packet in wire units (PROTOCOLS section 4). Optional fields may be missing at the end.
struct StatusPacket {
  static constexpr std::size_t kMaxEchoes = 60;  ///< maximum in the longest packet

  bool moving = false;
  std::uint16_t x_counts = 0, y_counts = 0;  ///< as sent: wraps
  std::int16_t heading_units = 0;
  std::int16_t left_velocity = 0, right_velocity = 0;
  std::uint8_t battery_decivolt = 0;
  std::uint16_t stall_bump = 0;
  std::uint16_t flags = 0;
  std::size_t echoes = 0;  ///< only new sonar readings
  std::array<SonarEcho, kMaxEchoes> echo{};
  std::optional<std::uint8_t> digital_in, digital_out;
  std::optional<std::uint16_t> battery_x10;
  std::optional<std::uint8_t> charge_state;
  std::optional<std::int16_t> rotation_decidegps;
  std::optional<std::uint16_t> fault_flags;
  std::optional<std::int8_t> temperature_c;
  std::optional<std::uint8_t> state_of_charge_percent;

  [[nodiscard]] bool motors_enabled() const { return (flags & 1U) != 0; }
};

/// Nothing for types other than 0x32 and 0x33, and for a packet that ends before its sonar readings do.
std::optional<StatusPacket> decode_status(std::span<const std::byte> payload);

/// Sets all fields except the pose, the twist and the packet's number, in SI units. Sonar readings that this
/// packet does not contain stay unchanged.
void apply_status(const StatusPacket& packet, const RobotModel& model, types::Stamp arrival,
                  types::BaseState& state);

/// From the wheels' speeds: some firmware and simulators leave the rotation field at 0.
types::Twist2 measured_twist(const StatusPacket& packet, const RobotModel& model);

}  // namespace topo::pioneer
