// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/types/result.hpp"
#include "daemon/config/configuration.hpp"

namespace topo::daemon {

/// Sets up spdlog's default logger: standard error (with the journal's priority prefixes when systemd reads
/// it, see sd-daemon(3)) or the file. A thread of spdlog writes the lines: a terminal or a disk that blocks
/// must not delay main, and with it an e-stop. When it blocks for long, the oldest lines are lost. Logging
/// locks, so real-time threads post events instead. To be called with the signals blocked.
types::Status start_logging(const LogConfig& config);

/// Writes pending lines and ends the thread; nothing may be logged afterwards.
void end_logging();

void set_log_level(LogLevel level);

/// Parses a level as spelt in the configuration.
std::optional<LogLevel> parse_log_level(std::string_view text);

}  // namespace topo::daemon
