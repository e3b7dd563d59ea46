// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/types/result.hpp"

namespace topo::bench {

struct TableCommand {
  std::vector<std::filesystem::path> worlds;  ///< files, and folders of them
  std::string suite;  ///< fresh: drawn buildings; dev: the public plans, in the folder `worlds`
  std::optional<std::uint64_t> suite_seed;  ///< of the drawn buildings
  int buildings = 24;                       ///< drawn
  std::vector<std::string> strategies{"topometric", "nearest_frontier", "greedy_frontier", "utility_frontier",
                                      "min_pos"};
  std::vector<int> robots{1, 2};
  int seeds = 8;
  std::string starts =
      "drawn";  ///< drawn: another with every seed (start_of_seed); own: the world's with all
  std::string fidelity = "plan", finish = "complete";
  std::vector<std::string> radios{"perfect"};
  double limit_s = 3600.0;
  double area_min_m2 = 0.0, area_max_m2 = HUGE_VAL;  ///< reachable, of the worlds that take part
  std::string share;                 ///< whose failing is a run's failing; empty: t99 of complete, else t95
  std::vector<std::string> compare;  ///< contest.hpp; empty: usual_contests
  std::string program;               ///< stands for this program in the log's lines; empty: its fingerprint
  int jobs = 0;                      ///< at once; 0: as many as there are processors
  int wall_limit_s = 3600;           ///< of one run
  bool no_runs = false;              ///< the table of what is there
  std::filesystem::path out;
  bool json = false;
};

/// `topobench explore-table`: explorations of worlds by strategies, numbers of robots and seeds, as many at
/// once as there are processors; runs.jsonl in the folder remembers them (run_log.hpp), so that it can be
/// stopped at any time and goes on where it was, and bounds.jsonl the bounds (table_bounds.hpp). Then prints
/// what they come to, and writes table.md, table.json and coverage-WORLD-ROBOTS.png (and
/// coverage-all-ROBOTS.png) beside it: all strategies with the first radio, and the first with all.
types::Status run_table(const TableCommand& command);

}  // namespace topo::bench
