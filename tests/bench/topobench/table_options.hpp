// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

#include "tests/bench/topobench/bound/bound_command.hpp"
#include "tests/bench/topobench/fresh/suite_command.hpp"
#include "tests/bench/topobench/table/table_command.hpp"

// The command line of what judges a policy over many buildings.
namespace topo::bench {

/// An empty name is a variable of the shell that is not set, and not the wish for no files.
CLI::Validator not_empty();
/// Accepts what exploration::parse_finish does.
CLI::Validator finish_form();

void add_options(CLI::App& app, TableCommand& table);
void add_options(CLI::App& app, BoundCommand& bound);
void add_options(CLI::App& app, SuiteCommand& suite);

}  // namespace topo::bench
