// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace topo::daemon {

/// Parses the command line of `program`, and adds --version. Nothing: continue. Otherwise the exit status: 0
/// when the requested text was printed, 2 when the command line is wrong. Faults are printed; for a misspelt
/// subcommand, with the nearest valid one.
std::optional<int> parse_command_line(CLI::App& cli, const std::string& program, int argc, char** argv);

/// Accepts a number from `low` to `high`. Rejects NaN, which CLI::Range accepts.
CLI::Validator number_from(double low, double high);

}  // namespace topo::daemon
