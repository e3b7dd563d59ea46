// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace topo::pioneer {

/// The fields of CONFIGpac that are used (PROTOCOLS section 5), in wire units. Missing at the end (older
/// firmware): 0.
struct ConfigPacket {
  std::string robot_class, subclass, serial_number, name, firmware;
  int rot_velocity_top_degps = 0;
  int velocity_top_mmps = 0;
  int rot_acceleration_top_degps2 = 0;
  int acceleration_top_mmps2 = 0;
  int sip_cycle_ms = 0;
  int host_baud_code = 0;
  int low_battery_decivolt = 0;
  int watchdog_ms = 0;
  int front_bumps = 0, rear_bumps = 0;
  int auto_baud = 0;
  int has_gyro = 0;  ///< 1: it sends readings; 2: it corrects its heading itself
  int ticks_per_mm = 0;
  int shutdown_decivolt = 0;
};

/// The answer to the requests for CONFIG.
struct ConfigAnswer {
  std::optional<ConfigPacket> packet;
  int damaged = 0;  ///< how many came with a wrong checksum or cut short; 0 and no packet: none came
};

/// Decodes a payload that begins with type 0x20. Nothing for another type, or when no field follows the
/// robot's name: the limits before the name, without which the robot cannot be driven, may be missing.
std::optional<ConfigPacket> decode_config(std::span<const std::byte> payload);

}  // namespace topo::pioneer
