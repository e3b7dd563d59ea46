// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "core/types/result.hpp"
#include "tests/bench/topobench/table/averages.hpp"
#include "tests/bench/topobench/table/run_key.hpp"
#include "tests/bench/topobench/table/run_log.hpp"
#include "tests/bench/topobench/table/table_world.hpp"
#include "tests/bench/topobench/table/worker_processes.hpp"

namespace topo::bench {

struct PlannedRun {
  RunKey key;
  std::filesystem::path file;  ///< of the world
};

/// One exploration: its report as REPORTS "topobench explore" has it. Done in a process of its own.
using Exploration = std::function<types::Result<nlohmann::json>(const PlannedRun&)>;

/// Looks on while runs are done, in the parent.
class TableWatch {
 public:
  virtual ~TableWatch() = default;
  /// Before the first: how many there are, and how many of them are in the log already.
  virtual void begun(std::size_t /*all*/, std::size_t /*there*/) {}
  virtual void finished(const PlannedRun& /*run*/) {}
  /// It gave no report: it crashed, or could not be begun.
  virtual void crashed(const PlannedRun& /*run*/, const std::string& /*why*/) {}
};

/// Every world with every seed, and for each of these everybody in it: what is compared is done together.
/// `common`: what is the same in all.
std::vector<PlannedRun> plan_runs(std::span<const TableWorld> worlds, std::span<const Entrant> entrants,
                                  const RunKey& common);

/// Does what the log has no report of, and puts it there. One that crashed is tried again the next time.
types::Status do_runs(std::span<const PlannedRun> runs, const WorkerLimits& limits,
                      const Exploration& explore, RunLog& log, TableWatch& watch);

/// What the log has of the runs.
types::Result<std::vector<TableRun>> table_runs_of(std::span<const PlannedRun> runs, const RunLog& log,
                                                   Time finished_share);

}  // namespace topo::bench
