// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "daemon/control/turns.hpp"

namespace topo::daemon {

/// How many clients are connected at a time. Those who may command have seats of their own.
struct Seats {
  std::size_t commanding = 32;
  std::size_t others = 16;
  std::size_t of_one_other = 8;  ///< of one user who may not command
};

/// The client that has to leave for a newcomer, as an index of `clients` (oldest first); nothing when there
/// is room. Any user may e-stop, so a newcomer is always taken: the oldest leaves of those who may command,
/// or of the newcomer's own connections, or of the connections of the user who has most. Pure.
[[nodiscard]] std::optional<std::size_t> who_leaves(std::span<const Standing> clients,
                                                    const Standing& newcomer, const Seats& seats);

}  // namespace topo::daemon
