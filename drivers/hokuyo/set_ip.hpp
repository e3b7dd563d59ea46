// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/types/result.hpp"
#include "drivers/hokuyo/connection.hpp"
#include "drivers/io/byte_stream.hpp"

// The network address of a Hokuyo Ethernet scanner (PROTOCOLS sections 10, 11.1 and 13): $IP, in effect after
// a power cycle, and shown to be by then only. Not while the scanner is in use: it serves one client.
namespace topo::hokuyo {

struct IpSettings {
  std::array<std::uint8_t, 4> address{}, netmask{255, 255, 255, 0}, gateway{};
};

/// "192.168.0.11" in four numbers of 0 to 255; kInvalidInput for anything else.
[[nodiscard]] types::Result<std::array<std::uint8_t, 4>> parse_ipv4(std::string_view text);
[[nodiscard]] std::string to_text(const std::array<std::uint8_t, 4>& address);
/// kInvalidInput when no host can have this address in this network, or its gateway is not in it.
[[nodiscard]] types::Status check(const IpSettings& settings);

/// Sends the scanner its new address; returns the scanner that took it. `serial_number`: that it must report;
/// empty: any.
/// kUnsupported, and nothing sent, when the model has no address; kInvalidInput for another scanner;
/// kUnsupported as well when the scanner refuses the command.
[[nodiscard]] types::Result<SensorInfo> set_ip(io::Connector& connector, const IpSettings& settings,
                                               std::string_view serial_number = {});

/// Waits until the scanner with `serial_number` answers at its new address, at most `patience`. kTimeout when
/// nothing does, kInvalidInput when another scanner does.
[[nodiscard]] types::Status await_sensor(io::Connector& connector, std::string_view serial_number,
                                         types::Duration patience);

}  // namespace topo::hokuyo
