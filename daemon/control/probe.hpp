// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <string>

#include "core/types/stamp.hpp"

namespace topo::daemon {

/// Who is behind a control socket.
enum class Served {
  kNobody,    ///< no daemon, or none that we can reach
  kByHung,    ///< one that holds the socket and answers nothing: stopped, or stuck
  kByLiving,  ///< one that answers, or at least hangs up time and again
};

struct Probe {
  Served served = Served::kNobody;
  pid_t pid = 0;  ///< of the daemon; 0: not known
};

/// Asks for the version, and waits `patience` for any answer. Who hangs up is asked again: a daemon that ends
/// is nobody soon. Blocks at most three times as long.
[[nodiscard]] Probe probe(const std::string& socket, types::Duration patience);

}  // namespace topo::daemon
