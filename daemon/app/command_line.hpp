// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "daemon/app/version.hpp"

namespace topo::daemon {

/// Parses the command line of `program`, and adds --version. Nothing: go on. Else the exit status to end
/// with: 0 when what was asked for is printed, 2 when the command line is wrong, which is said.
inline std::optional<int> parse_command_line(CLI::App& cli, const std::string& program, int argc,
                                             char** argv) {
  constexpr int kWrong = 2;
  cli.set_version_flag("--version", program + " " + kVersion, "print the version and exit");
  try {
    cli.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return cli.exit(error) == 0 ? 0 : kWrong;
  }
  return {};
}

}  // namespace topo::daemon
