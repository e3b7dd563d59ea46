// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <string>

#include "core/types/stamp.hpp"

namespace topo::daemon {

/// State of the server behind a control socket.
enum class Served {
  kNobody,    ///< no daemon, or none that can be reached
  kByHung,    ///< a daemon that holds the socket but does not answer: stopped, or stuck
  kByLiving,  ///< a daemon that answers, or that closes every connection
};

struct Probe {
  Served served = Served::kNobody;
  pid_t pid = 0;  ///< of the daemon; 0: unknown
};

/// Requests the version, and waits `patience` for any answer. When the server closes the connection, it tries
/// again: a daemon that is ending will soon be gone. Blocks at most three times as long.
[[nodiscard]] Probe probe(const std::string& socket, types::Duration patience);

}  // namespace topo::daemon
