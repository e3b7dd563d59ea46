// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "tests/bench/topobench/table/averages.hpp"

namespace topo::bench {

/// What is told of a table's runs.
struct Table {
  std::vector<std::string> worlds;
  std::string share;  ///< name of the time without which a run has failed
  std::vector<Average> averages;
  std::vector<std::vector<Average>> by_world;  ///< of each world, with the same entrants
  std::vector<Comparison> comparisons;
  std::vector<Breakdown> breakdowns;
  std::vector<TableRun> failures;
  nlohmann::json setup;  ///< what all runs have in common
};

/// In Markdown, with what the columns mean.
std::string text_of(const Table& table);

/// The same for programs; an interval's end that is not known is null.
nlohmann::json json_of(const Table& table);

}  // namespace topo::bench
