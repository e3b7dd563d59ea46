// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace topo::pioneer {

/// What we use of CONFIGpac (PROTOCOLS section 5), in wire units. Missing at the end (older firmware): 0.
struct ConfigPacket {
  std::string robot_class, subclass, serial_number, name, firmware;
  int rot_velocity_top_degps = 0;
  int velocity_top_mmps = 0;
  int rot_acceleration_top_degps2 = 0;
  int acceleration_top_mmps2 = 0;
  int sip_cycle_ms = 0;
  int host_baud_code = 0;
  int front_sonar = 0, rear_sonar = 0;
  int low_battery_decivolt = 0;
  int watchdog_ms = 0;
  int front_bumps = 0, rear_bumps = 0;
  int auto_baud = 0;
  int ticks_per_mm = 0;
  int shutdown_decivolt = 0;
};

/// From a payload that begins with type 0x20; nothing when it does not, or when it ends before the limits
/// without which a robot cannot be driven.
std::optional<ConfigPacket> decode_config(std::span<const std::byte> payload);

}  // namespace topo::pioneer
