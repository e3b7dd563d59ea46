// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "core/types/result.hpp"

namespace topo::bench {

struct SlamCommand {
  std::string log;
  std::string relations;      ///< empty: none
  std::filesystem::path out;  ///< empty: no files
  bool json = false;
};

/// `topobench slam`: maps a log, writes the map and the trajectory, prints the report of REPORTS "topobench
/// slam".
types::Status run_slam(const SlamCommand& command);

}  // namespace topo::bench
