// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/averages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace topo::bench {
namespace {

using nlohmann::json;

bool is_number(const json& report, const char* key) {
  return report.contains(key) && report[key].is_number();
}

/// Above 0, so that it has a logarithm; null: it never came.
bool is_time(const json& report, const char* key) {
  if (!report.contains(key)) return false;
  return report[key].is_null() || (report[key].is_number() && report[key].get<double>() > 0.0);
}

template <class Test>
bool is_list_of(const json& report, const char* key, Test&& is_one) {
  return report.contains(key) && report[key].is_array() &&
         std::all_of(report[key].begin(), report[key].end(), is_one);
}

bool is_count(const json& value) { return value.is_number_integer() && value >= 0; }

/// The first key that is not as REPORTS has it; null when all are.
const char* strange_key(const json& report) {
  for (const char* key : {"t50_s", "t90_s", "t95_s", "t99_s", "t_home_s"}) {
    if (!is_time(report, key)) return key;
  }
  if (!report.contains("collisions") || !is_count(report["collisions"])) return "collisions";
  if (!is_list_of(report, "home", [](const json& home) { return home.is_boolean(); })) return "home";
  if (!is_list_of(report, "distance_m", [](const json& d) { return d.is_number(); })) return "distance_m";
  // Null: nothing was decided, in a run that was over at once.
  if (!report.contains("decision_ms") ||
      !(report["decision_ms"].is_null() ||
        (report["decision_ms"].is_object() && is_number(report["decision_ms"], "p99"))))
    return "decision_ms";
  const auto is_point = [](const json& point) {
    return point.is_array() && point.size() == 2 && point[0].is_number() && point[1].is_number();
  };
  return is_list_of(report, "coverage", is_point) ? nullptr : "coverage";
}

/// The runs of one entrant by world and seed.
using RunsByCondition = std::map<std::pair<std::string, std::uint64_t>, const TableRun*>;
RunsByCondition by_condition(std::span<const TableRun> runs, const Entrant& entrant) {
  RunsByCondition out;
  for (const TableRun& run : runs) {
    if (run.entrant == entrant) out[{run.world, run.seed}] = &run;
  }
  return out;
}

double time_of_all(const RunsByCondition& runs, const RunsByCondition& conditions, std::size_t time) {
  double sum = 0.0;
  for (const auto& [condition, run] : conditions) sum += runs.at(condition)->times_s[time];
  return sum;
}

/// Why a run did not come home with its work done; empty: it did.
std::string failure_of(const TableRun& run, const json& report, const std::string& share) {
  if (run.collisions > 0) return fmt::format("{} collisions", run.collisions);
  if (run.robots_not_home > 0) return fmt::format("{} robots not home", run.robots_not_home);
  if (report[share + "_s"].is_null()) return fmt::format("did not reach {}", share);
  if (report["t_home_s"].is_null()) return "not done when the time was over";
  return {};
}

}  // namespace

TableRun crashed_run(const RunKey& key, std::string why) {
  TableRun run;
  run.world = key.world;
  run.seed = key.seed;
  run.start = key.start;
  run.entrant = key.entrant;
  run.times_s.fill(key.limit_s);
  run.failed = run.crashed = true;
  run.why = std::move(why);
  run.robots_not_home = key.entrant.robots;
  return run;
}

types::Result<TableRun> table_run_of(const RunKey& key, const json& report, Time finished_share) {
  if (const char* strange = strange_key(report); strange != nullptr)
    return types::fail(types::Errc::kInvalidInput,
                       fmt::format("report of a run in {}: found no '{}' as topobench explore writes it",
                                   key.world, strange));
  TableRun run = crashed_run(key, "");
  run.crashed = false;
  const json& home = report["home"];
  run.robots_not_home = static_cast<int>(std::count(home.begin(), home.end(), json(false)));
  run.collisions = report["collisions"].get<std::uint64_t>();
  run.why = failure_of(run, report, kTimeNames[static_cast<std::size_t>(finished_share)]);
  run.failed = !run.why.empty();
  const bool safe = run.robots_not_home == 0 && run.collisions == 0;
  for (std::size_t i = 0; i < kTimes; ++i) {
    const json& reached = report[fmt::format("{}_s", kTimeNames[i])];
    const bool counts = static_cast<Time>(i) == Time::kHome ? !run.failed : safe && !reached.is_null();
    if (counts) run.times_s[i] = reached.get<double>();
  }
  for (const json& distance_m : report["distance_m"]) run.distance_m += distance_m.get<double>();
  if (is_number(report, "overlap")) run.overlap = report["overlap"].get<double>();
  if (!report["decision_ms"].is_null()) run.decision_p99_ms = report["decision_ms"]["p99"].get<double>();
  for (const json& point : report["coverage"])
    run.coverage.emplace_back(point[0].get<double>(), point[1].get<double>());
  run.parts = breakdown_of(report);
  return run;
}

Average average_of(const Entrant& entrant, std::span<const TableRun> runs) {
  Average out;
  out.entrant = entrant;
  double whole = 0.0, overlaps = 0.0, overlap = 0.0;
  for (const auto& [condition, run] : by_condition(runs, entrant)) {
    ++out.runs;
    out.failed += run->failed ? 1U : 0U;
    for (std::size_t i = 0; i < kTimes; ++i) {
      out.times_s[i] += run->times_s[i];
      out.worst_s[i] = std::max(out.worst_s[i], run->times_s[i]);
    }
    out.collisions += run->collisions;
    out.robots_not_home += run->robots_not_home;
    if (run->crashed) continue;
    whole += 1.0;
    out.distance_m += run->distance_m;
    out.decision_p99_ms += run->decision_p99_ms;
    out.decision_p99_worst_ms = std::max(out.decision_p99_worst_ms, run->decision_p99_ms);
    if (!run->overlap) continue;
    overlaps += 1.0;
    overlap += *run->overlap;
  }
  for (double& time_s : out.times_s) time_s /= std::max(static_cast<double>(out.runs), 1.0);
  out.distance_m /= std::max(whole, 1.0);
  out.decision_p99_ms /= std::max(whole, 1.0);
  if (overlaps > 0.0) out.overlap = overlap / overlaps;
  return out;
}

Comparison compare(std::span<const TableRun> runs, const Contest& contest) {
  const RunsByCondition of_a = by_condition(runs, contest.a);
  std::vector<RunsByCondition> of_b;
  for (const Entrant& b : contest.b) of_b.push_back(by_condition(runs, b));
  std::map<std::string, RunsByCondition> worlds;  // runs of a which all the others have, too
  for (const auto& [condition, run] : of_a) {
    const bool all_have = std::all_of(of_b.begin(), of_b.end(),
                                      [&](const RunsByCondition& b) { return b.contains(condition); });
    if (all_have) worlds[run->world][condition] = run;
  }
  Comparison out{contest, {}};
  for (std::size_t i = 0; i < kTimes && !of_b.empty(); ++i) {
    std::vector<Pair> pairs;
    for (const auto& [world, runs_of_a] : worlds) {
      const RunsByCondition& best =
          *std::min_element(of_b.begin(), of_b.end(), [&](const auto& b, const auto& c) {
            return time_of_all(b, runs_of_a, i) < time_of_all(c, runs_of_a, i);
          });
      for (const auto& [condition, run] : runs_of_a)
        pairs.push_back({world, run->times_s[i], best.at(condition)->times_s[i]});
    }
    out.ratios[i] = paired_ratio(pairs);
  }
  return out;
}

}  // namespace topo::bench
