// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "daemon/control/json_rpc.hpp"

namespace topo::daemon {

// The daemon's answers as tables for users. Missing members show as "-": an older daemon may have fewer.

std::string status_table(const Json& status);
std::string latency_table(const Json& latency);
std::string health_table(const Json& health);
std::string goals_table(const Json& goals);
std::string why_table(const Json& goals);
std::string places_table(const Json& places);
std::string doctor_table(const Json& doctor);
std::string sessions_table(const Json& answer);
std::string team_table(const Json& team);
std::string areas_table(const Json& areas);
/// One line, with its line end.
std::string mission_text(const Json& mission);
/// The status on one line without line end, for the command watch.
std::string watch_line(const Json& status);

/// The member at a path such as "/map/keyframes" as text: "yes" and "no", three decimals; "-" when missing.
std::string text_at(const Json& json, const char* path);
/// True when such a text is neither "-" nor empty.
bool is_said(std::string_view text);

}  // namespace topo::daemon
