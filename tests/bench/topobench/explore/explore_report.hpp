// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/bench/topobench/explore/team_run.hpp"

namespace topo::bench {

/// What was asked for, for the report.
struct RunTitle {
  std::string world, strategy, finish;
  std::uint64_t seed = 1;
  std::string radio = "none";
};

/// The keys of REPORTS "topobench explore", and some more.
nlohmann::json report_of(const RunTitle& title, const RunSetup& setup, const RunResult& result,
                         double reachable_m2);

/// The same keys of a team's run; `distance_m` and `home` by robot, and `overlap`.
nlohmann::json team_report_of(const RunTitle& title, const TeamSetup& setup, const TeamResult& result,
                              double reachable_m2);

/// explore.png (true walls, area, path, goals), coverage.png, decisions.txt and poses.tsv in an existing
/// folder.
types::Status write_run_files(const std::filesystem::path& folder, const sim::World& world,
                              const RunSetup& setup, const RunResult& result, const sim::Raster& visible);

/// The same of a team: pictures of all together, and decisions-N.txt and poses-N.tsv of each robot.
types::Status write_team_files(const std::filesystem::path& folder, const sim::World& world,
                               const TeamSetup& setup, const TeamResult& result, const sim::Raster& visible);

}  // namespace topo::bench
