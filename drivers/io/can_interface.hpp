// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/types/result.hpp"
#include "drivers/io/can_error.hpp"

namespace topo::io {

/// The kernel's numbering (linux/can/netlink.h).
enum class CanState : std::uint8_t { kActive, kWarning, kPassive, kBusOff, kStopped, kSleeping };

/// The kernel's data about a network interface that is meant to be a CAN interface. Attributes that the
/// interface does not have are missing.
struct CanInterface {
  bool exists = false;
  bool is_can = false;
  bool up = false;
  std::uint32_t queue_length = 0;
  std::optional<std::uint32_t> bit_rate_bps;  ///< also missing when it was never set
  std::optional<std::uint32_t> restart_ms;    ///< 0: after bus-off an operator must restart it
  std::optional<CanState> state;              ///< present for every controller
  std::optional<CanErrorCounters> errors;

  [[nodiscard]] bool is_virtual() const { return !state; }
};

/// A fault of an interface, and the command that cures it.
struct CanComplaint {
  std::string found;
  std::string cure;
  bool blocks = false;  ///< nothing gets through before it is cured
};

/// The command that configures a controller according to the profile (PROTOCOLS section 14.3); it must be
/// down. A controller that cannot report bus errors refuses its last two words.
[[nodiscard]] std::string can_bring_up_command(const std::string& name);

/// Queries the kernel (rtnetlink); needs no privilege. A missing interface is not an error.
[[nodiscard]] types::Result<CanInterface> query_can_interface(const std::string& name);

/// Parses the kernel's answer to RTM_GETLINK; `message` includes the header. Attributes that it does not
/// contain are missing.
[[nodiscard]] CanInterface parse_link(std::span<const std::byte> message);

/// The first condition found that prevents driving the robot over the interface: missing, not a CAN
/// interface, a bit rate outside the profile (PROTOCOLS section 14.1), switched off, bus-off, no
/// acknowledgement, error passive, a queue shorter than one transfer. Nothing when all is well.
[[nodiscard]] std::optional<CanComplaint> complaint_about(const CanInterface& interface,
                                                          const std::string& name);

}  // namespace topo::io
