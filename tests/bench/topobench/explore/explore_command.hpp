// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/types/result.hpp"

namespace topo::bench {

struct ExploreCommand {
  std::filesystem::path world;
  int robots = 1;
  std::string strategy = "topometric";
  std::uint64_t seed = 1;
  std::string fidelity = "full";
  std::string finish = "complete";
  double limit_s = 1800.0;
  std::vector<double> start;  ///< x, y, theta; empty: the world's
  std::filesystem::path out;  ///< empty: no files
  bool json = false;
};

/// `topobench explore`: one exploration in lock-step with the simulated building; prints the report of
/// REPORTS "topobench explore". Fails only when it could not run: what became of the exploration is in the
/// keys.
types::Status run_explore(const ExploreCommand& command);

}  // namespace topo::bench
