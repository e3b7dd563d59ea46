// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace topo::daemon {

/// Parses the command line of `program`, and adds --version. Nothing: go on. Else the exit status to end
/// with: 0 when what was asked for is printed, 2 when the command line is wrong, which is said; of a
/// misspelt subcommand with the one that is near.
std::optional<int> parse_command_line(CLI::App& cli, const std::string& program, int argc, char** argv);

/// A number from `low` to `high`. NaN is none, which CLI::Range lets pass.
CLI::Validator number_from(double low, double high);

}  // namespace topo::daemon
