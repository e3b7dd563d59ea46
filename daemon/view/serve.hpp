// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/types/result.hpp"
#include "daemon/config/configuration.hpp"

namespace topo::daemon {

/// Serves the page until SIGTERM, SIGINT or SIGHUP, on the calling thread. kIo or kInvalidInput when it
/// cannot listen. Tells the service manager when it is ready and, with WATCHDOG_USEC, that it lives.
types::Status serve_view(const Configuration& configuration);

/// As serve_view(), but of a mission that is over: `path` is a session, a folder of sessions, or a recording,
/// of which a topometricd with the configuration `file` makes a session meanwhile. kNotFound and
/// kInvalidInput when there is nothing to show.
types::Status serve_replay(const Configuration& configuration, const std::string& file,
                           const std::string& path);

}  // namespace topo::daemon
