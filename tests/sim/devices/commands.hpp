// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace topo::sim {

class SimRig;

/// Executes one line of the control protocol: {"command": NAME, ...} returns {"ok": true, ...} or
/// {"ok": false, "error": TEXT}. command_help() lists the names and their arguments.
[[nodiscard]] std::string run_command(SimRig& rig, const std::string& line);

/// One line per command, for --help.
[[nodiscard]] std::string command_help();

}  // namespace topo::sim
