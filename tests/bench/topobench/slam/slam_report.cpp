// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/slam/slam_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "tests/bench/topobench/output.hpp"

namespace topo::bench {
namespace {

nlohmann::json quantiles(std::vector<double> values) {
  if (values.empty()) return nullptr;
  std::sort(values.begin(), values.end());
  const auto at = [&](double q) {
    return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
  };
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  return {{"mean", mean}, {"p50", at(0.5)}, {"p99", at(0.99)}, {"p999", at(0.999)}, {"max", values.back()}};
}

nlohmann::json stage(const StageTimes& times) {
  return {{"count", times.cpu_ms.size()},
          {"cpu_ms", quantiles(times.cpu_ms)},
          {"wall_ms", quantiles(times.wall_ms)}};
}

double sum_s(const std::vector<double>& ms) { return 1e-3 * std::accumulate(ms.begin(), ms.end(), 0.0); }

}  // namespace

double path_length_m(const MappingRun& run) {
  double length = 0.0;
  for (std::size_t i = 1; i < run.trajectory.size(); ++i) {
    length += (run.trajectory[i].pose.translation() - run.trajectory[i - 1].pose.translation()).norm();
  }
  return length;
}

nlohmann::json report_of(const pipeline::MappingState& state, const MappingRun& run) {
  return {{"keyframes", state.mapper().keyframes().size()},
          {"closures", {{"accepted", run.closures_accepted}, {"rejected", run.closures_rejected}}},
          {"lost", run.lost},
          {"searched", run.searched},
          {"degenerate", run.degenerate},
          {"path_m", path_length_m(run)},
          {"cpu_s", sum_s(run.step.cpu_ms) + sum_s(run.loop_search.cpu_ms) + sum_s(run.graph.cpu_ms) +
                        sum_s(run.end.cpu_ms)},
          {"wall_s", sum_s(run.step.wall_ms) + sum_s(run.loop_search.wall_ms) + sum_s(run.graph.wall_ms) +
                         sum_s(run.end.wall_ms)},
          {"match_ms", quantiles(run.scan.cpu_ms)},
          {"closure_ms", quantiles(run.loop_search.cpu_ms)},
          {"stages",
           {{"scan", stage(run.scan)},
            {"step", stage(run.step)},
            {"track", stage(run.track)},
            {"keyframe", stage(run.keyframe)},
            {"correction", stage(run.correction)},
            {"loop_search", stage(run.loop_search)},
            {"graph", stage(run.graph)},
            {"end", stage(run.end)}}},
          {"peak_rss_mb", peak_rss_mb()}};
}

nlohmann::json error_report(std::span<const PosePair> pairs) {
  if (pairs.empty()) return nullptr;
  const types::Se2 fit = best_fit(pairs);
  const types::Se2 first = pairs.front().T_building_base * pairs.front().T_map_base.inverse();
  const PathError fitted = path_error(pairs, fit), anchored = path_error(pairs, first);
  double turn2 = 0.0;
  for (const PosePair& pair : pairs) {
    const double off = types::wrap_angle((fit * pair.T_map_base).theta_rad - pair.T_building_base.theta_rad);
    turn2 += off * off;
  }
  return {{"rmse_m", fitted.rmse_m},
          {"worst_m", fitted.worst_m},
          {"heading_rmse_deg", std::sqrt(turn2 / static_cast<double>(pairs.size())) / types::kDegree_rad},
          {"rmse_by_first_pose_m", anchored.rmse_m},
          {"worst_by_first_pose_m", anchored.worst_m}};
}

}  // namespace topo::bench
