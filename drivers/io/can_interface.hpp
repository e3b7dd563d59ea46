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

/// As the kernel numbers them (linux/can/netlink.h).
enum class CanState : std::uint8_t { kActive, kWarning, kPassive, kBusOff, kStopped, kSleeping };

/// What the kernel knows of a network interface that is to be a CAN interface. What one does not have is
/// missing.
struct CanInterface {
  bool exists = false;
  bool is_can = false;
  bool up = false;
  std::uint32_t queue_length = 0;
  std::optional<std::uint32_t> bit_rate_bps;  ///< missing as well when it was never set
  std::optional<std::uint32_t> restart_ms;    ///< 0: after bus-off a person has to restart it
  std::optional<CanState> state;              ///< every controller has one
  std::optional<CanErrorCounters> errors;

  [[nodiscard]] bool is_virtual() const { return !state; }
};

/// What is wrong with an interface, and the command that cures it.
struct CanComplaint {
  std::string found;
  std::string cure;
  bool blocks = false;  ///< nothing gets through until it is cured
};

/// The command that sets a controller up as the profile has it (PROTOCOLS section 14.3); it must be down. A
/// controller that cannot report bus errors refuses its last two words.
[[nodiscard]] std::string can_bring_up_command(const std::string& name);

/// Asks the kernel (rtnetlink); needs no privilege. An interface that is not there is no error.
[[nodiscard]] types::Result<CanInterface> query_can_interface(const std::string& name);

/// Takes the kernel's answer to RTM_GETLINK apart; `message`: with its header. Whatever it does not hold is
/// missing.
[[nodiscard]] CanInterface parse_link(std::span<const std::byte> message);

/// The first thing that keeps the robot from being driven over it: missing, no CAN interface, switched off, a
/// bit rate that the profile does not know (PROTOCOLS section 14.1), bus-off, nobody acknowledges, error
/// passive, a queue shorter than one transfer. Nothing when all is well.
[[nodiscard]] std::optional<CanComplaint> complaint_about(const CanInterface& interface,
                                                          const std::string& name);

}  // namespace topo::io
