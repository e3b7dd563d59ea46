// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/pipeline/planning_step.hpp"
#include "core/types/result.hpp"
#include "tests/bench/topobench/explore/explore_run.hpp"

namespace topo::bench {

struct ExploreCommand {
  std::filesystem::path world;
  int robots = 1;
  std::string strategy = "topometric";  ///< contender.hpp
  std::uint64_t seed = 1;
  std::string fidelity = "full";
  std::string finish = "complete";
  double limit_s = 1800.0;
  std::string radio = "perfect";  ///< of several robots: see parse_radio()
  double contact_lost_s = pipeline::PlannerParams{}.contact_lost_s;
  double entry_delay_s = 0.0;  ///< of several robots: from one's beginning to the next one's
  bool starts_known = true;    ///< of several robots: to them
  std::vector<double> start;   ///< x, y, theta; empty: the world's
  double v_max_mps = types::DriveLimits{}.v_max_mps;
  std::string calibration;    ///< calibration_names(); empty: the usual robot
  bool bound = false;         ///< the way against that of robots that know the building (bound_command.hpp)
  std::filesystem::path out;  ///< empty: no files
  bool json = false;
};

/// Is it so many seconds that an exploration may last?
types::Status check_limit(double limit_s);

/// One exploration as commanded, with its files but without a message on standard output: the report of
/// REPORTS "topobench explore". `hooks`: of the first robot. The same command gives the same report but for
/// what says how long it took.
types::Result<nlohmann::json> explore(const ExploreCommand& command, RunHooks& hooks);

/// `topobench explore`: one exploration in lock-step with the simulated building; prints the report. Fails
/// only when it could not run: what became of the exploration is in the keys.
types::Status run_explore(const ExploreCommand& command);

}  // namespace topo::bench
