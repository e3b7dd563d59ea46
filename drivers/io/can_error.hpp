// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace topo::io {

/// The two error counters of ISO 11898-1: warning from 96, error passive from 128; bus-off when the transmit
/// counter exceeds 255.
struct CanErrorCounters {
  std::uint8_t transmit = 0;
  std::uint8_t receive = 0;
  friend bool operator==(const CanErrorCounters&, const CanErrorCounters&) = default;
};

/// State of the controller and of the bus that one error frame reports (linux/can/error.h; PROTOCOLS section
/// 14.3). Several conditions may hold at once.
struct CanError {
  bool bus_off = false;         ///< the controller took itself off the bus
  bool restarted = false;       ///< the controller is back after bus-off
  bool passive = false;         ///< the controller may no longer signal errors actively: the bus is bad
  bool no_acknowledge = false;  ///< no node acknowledged a frame
  bool transmit_timeout = false;
  bool overflow = false;   ///< frames were lost in the controller
  bool violation = false;  ///< bit, stuffing or format error: noise, or another bit rate
  std::optional<CanErrorCounters> counters;
};

/// `id`: as the kernel passes it, with or without the error flag; missing bytes (fewer than eight) count as
/// zeros.
[[nodiscard]] CanError decode_can_error(std::uint32_t id, std::span<const std::byte> data);

[[nodiscard]] std::string to_text(const CanErrorCounters& counters);
/// Description for users, the gravest condition first; conditions that BusFaults counts use its words.
/// "nothing of importance" when no condition is set.
[[nodiscard]] std::string to_text(const CanError& error);

}  // namespace topo::io
