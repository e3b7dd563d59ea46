// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/table_runs.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace topo::bench {
namespace {

using nlohmann::json;

/// As of every second, the coverage is most of a line by far.
constexpr std::size_t kCoverageEvery = 5;

void thin_coverage(json& report) {
  if (!report.contains("coverage") || !report["coverage"].is_array()) return;
  const json all = std::move(report["coverage"]);
  json& some = report["coverage"] = json::array();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if ((i + 1) % kCoverageEvery == 0 || i + 1 == all.size()) some.push_back(all[i]);
  }
}

}  // namespace

std::vector<PlannedRun> plan_runs(std::span<const TableWorld> worlds, std::span<const Entrant> entrants,
                                  const RunKey& common) {
  std::size_t seeds = 0;
  for (const TableWorld& world : worlds) seeds = std::max(seeds, world.starts.size());
  std::vector<PlannedRun> runs;
  for (std::size_t i = 0; i < seeds; ++i) {
    for (const TableWorld& world : worlds) {
      if (i >= world.starts.size()) continue;
      for (const Entrant& entrant : entrants) {
        PlannedRun run{common, world.file};
        run.key.world = world.name;
        run.key.building = world.building;
        run.key.entrant = entrant;
        run.key.seed = i + 1;
        run.key.start = world.starts[i];
        runs.push_back(std::move(run));
      }
    }
  }
  return runs;
}

types::Status do_runs(std::span<const PlannedRun> runs, const WorkerLimits& limits,
                      const Exploration& explore, RunLog& log, TableWatch& watch) {
  std::vector<const PlannedRun*> missing;
  for (const PlannedRun& run : runs) {
    if (log.find(json_of(run.key)) == nullptr) missing.push_back(&run);
  }
  watch.begun(runs.size(), runs.size() - missing.size());
  const auto work = [&](std::size_t job) -> types::Result<std::string> {
    auto report = explore(*missing[job]);
    if (!report) return tl::unexpected(report.error());
    thin_coverage(*report);
    return report->dump();
  };
  const auto done = [&](std::size_t job, const types::Result<std::string>& text) -> types::Status {
    const PlannedRun& run = *missing[job];
    if (!text) {
      watch.crashed(run, text.error().message);
      return log.append_crash(json_of(run.key), text.error().message);
    }
    json report = json::parse(*text, nullptr, false);
    if (!report.is_object())
      return types::fail(
          types::Errc::kIo,
          fmt::format("a run in {}: found no report in what its process handed over", run.key.world));
    if (auto status = log.append(json_of(run.key), std::move(report)); !status) return status;
    watch.finished(run);
    return {};
  };
  return run_in_processes(missing.size(), limits, work, done);
}

types::Result<std::vector<TableRun>> table_runs_of(std::span<const PlannedRun> runs, const RunLog& log,
                                                   Time finished_share) {
  std::vector<TableRun> out;
  for (const PlannedRun& run : runs) {
    const json key = json_of(run.key);
    const json* report = log.find(key);
    const std::string* crash = log.find_crash(key);
    if (crash != nullptr) out.push_back(crashed_run(run.key, "no report: " + *crash));
    if (report == nullptr) continue;
    auto one = table_run_of(run.key, *report, finished_share);
    if (!one) return tl::unexpected(one.error());
    out.push_back(std::move(*one));
  }
  return out;
}

}  // namespace topo::bench
