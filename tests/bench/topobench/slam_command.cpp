// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/bench/topobench/slam_command.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>

#include "tests/bench/topobench/log_run.hpp"
#include "tests/bench/topobench/output.hpp"

namespace topo::bench {
namespace {

double degrees(double rad) { return rad * 180.0 / std::numbers::pi; }

nlohmann::json quantiles(std::vector<double> values) {
  if (values.empty()) return nullptr;
  std::sort(values.begin(), values.end());
  const auto at = [&](double q) {
    return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
  };
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  return {{"mean", mean}, {"p50", at(0.5)}, {"p99", at(0.99)}, {"p999", at(0.999)}, {"max", values.back()}};
}

double peak_rss_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

nlohmann::json report(const SlamCommand& command, const daemon::CarmenLog& log,
                      const pipeline::MappingState& state, const LogRun& run) {
  return {{"log", command.log},
          {"scans", log.scans.size()},
          {"stamp_inversions", log.stamp_inversions},
          {"keyframes", state.mapper().keyframes().size()},
          {"closures", {{"accepted", run.closures_accepted}, {"rejected", run.closures_rejected}}},
          {"lost", run.lost},
          {"searched", run.searched},
          {"path_m", run.path_m},
          {"cpu_s", run.cpu_s},
          {"wall_s", run.wall_s},
          {"match_ms", quantiles(run.match_ms)},
          {"closure_ms", quantiles(run.closure_ms)},
          {"peak_rss_mb", peak_rss_mb()}};
}

types::Result<nlohmann::json> relation_errors(const std::string& path, const LogRun& run) {
  const auto relations = daemon::read_relations(path);
  if (!relations) return tl::unexpected(relations.error());
  const daemon::RelationErrors errors = daemon::evaluate_relations(*relations, run.trajectory);
  return nlohmann::json{{"used", errors.used},
                        {"skipped", errors.skipped},
                        {"trans_mean_m", errors.trans_mean_m},
                        {"trans_std_m", errors.trans_std_m},
                        {"trans_max_m", errors.trans_max_m},
                        {"rot_mean_deg", degrees(errors.rot_mean_rad)},
                        {"rot_std_deg", degrees(errors.rot_std_rad)},
                        {"rot_max_deg", degrees(errors.rot_max_rad)}};
}

}  // namespace

types::Status run_slam(const SlamCommand& command) {
  const auto log = read_log(command.log);
  if (!log) return tl::unexpected(log.error());
  pipeline::MappingState state(params_for(*log));
  const LogRun run = run_log(*log, state, {});
  nlohmann::json json = report(command, *log, state, run);
  if (!command.relations.empty()) {
    auto errors = relation_errors(command.relations, run);
    if (!errors) return tl::unexpected(errors.error());
    json["relations"] = std::move(*errors);
  }
  if (!command.out.empty()) {
    if (auto written = write_map_files(command.out, *state.make_snapshot(), run); !written) return written;
  }
  fmt::print("{}\n", command.json ? json.dump() : json.dump(2));
  return {};
}

}  // namespace topo::bench
