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
/// it, see sd-daemon(3)) or the file. Only main logs.
types::Status start_logging(const LogConfig& config);

void set_log_level(LogLevel level);

/// As the configuration spells it.
std::optional<LogLevel> parse_log_level(std::string_view text);

}  // namespace topo::daemon
