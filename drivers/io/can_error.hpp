// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace topo::io {

/// The two counters of ISO 11898-1: from 96 a warning, from 128 error passive, beyond 255 sent bus-off.
struct CanErrorCounters {
  std::uint8_t transmit = 0;
  std::uint8_t receive = 0;
  friend bool operator==(const CanErrorCounters&, const CanErrorCounters&) = default;
};

/// What a controller says of itself and of the bus in one error frame (linux/can/error.h; PROTOCOLS section
/// 14.3). Several things may hold at once.
struct CanError {
  bool bus_off = false;         ///< it took itself off the bus
  bool restarted = false;       ///< it is back after bus-off
  bool passive = false;         ///< it may no longer mark errors of others: the bus is bad
  bool no_acknowledge = false;  ///< nobody took what was sent
  bool transmit_timeout = false;
  bool overflow = false;   ///< frames were lost in the controller
  bool violation = false;  ///< bit, stuffing or format error: noise, or another bit rate
  std::optional<CanErrorCounters> counters;
};

/// `id`: as the kernel gives it, the error flag set or not; fewer bytes than eight count as zeros.
[[nodiscard]] CanError decode_can_error(std::uint32_t id, std::span<const std::byte> data);

[[nodiscard]] std::string to_text(const CanErrorCounters& counters);
/// In plain words, the gravest first, those that BusFaults counts in its words; "nothing of importance" when
/// nothing is set.
[[nodiscard]] std::string to_text(const CanError& error);

}  // namespace topo::io
