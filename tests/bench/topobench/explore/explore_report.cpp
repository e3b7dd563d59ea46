// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/explore_report.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "daemon/mapfile/atomic_file.hpp"
#include "tests/bench/topobench/explore/coverage_plot.hpp"
#include "tests/bench/topobench/judge/path_error.hpp"
#include "tests/bench/topobench/output.hpp"
#include "tests/bench/topobench/overview.hpp"

namespace topo::bench {
namespace {

using nlohmann::json;

double rounded(double value, double step) { return std::round(value / step) * step; }

json or_null(const std::optional<double>& value) { return value ? json(*value) : json(nullptr); }

json quantiles_ms(std::vector<double> values) {
  if (values.empty()) return nullptr;
  std::sort(values.begin(), values.end());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  const auto p99 = static_cast<std::size_t>(0.99 * static_cast<double>(values.size() - 1));
  return {{"mean", mean}, {"p99", values[p99]}, {"max", values.back()}};
}

/// With the map laid on the building by the true start.
double ate_rmse_m(const RunSetup& setup, const RunResult& result) {
  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i < result.truth.size(); ++i)
    pairs.push_back({result.estimate[i], result.truth[i]});
  return path_error(pairs, setup.plant.start).rmse_m;
}

json coverage_list(const RunResult& result) {
  json list = json::array();
  for (const auto& [t_s, share] : result.coverage) list.push_back({t_s, rounded(share, 1e-5)});
  return list;
}

sim::Picture coverage_picture(const RunResult& result) {
  CoveragePlot plot(result.end_s);
  plot.curve(result.coverage, sim::kTruthInk);
  return plot.picture();
}

std::string decisions_text(const RunResult& result) {
  std::string text;
  for (const pipeline::Decision& decision : result.decisions) {
    fmt::format_to(std::back_inserter(text), "{:8.1f} s  ({:6.2f}, {:6.2f})  {}\n",
                   types::to_seconds(decision.stamp), decision.p_map.x(), decision.p_map.y(), decision.text);
  }
  return text;
}

/// `team`: whose coverage tells the times.
std::string poses_text(const RunSetup& setup, const RunResult& result, const RunResult& team) {
  std::string text = "# t_s x_m y_m theta_rad (true, in the building), the same as the robot believed it\n";
  for (std::size_t i = 0; i < result.truth.size(); ++i) {
    const sim::Se2& a = result.truth[i];
    const sim::Se2 b = setup.plant.start * result.estimate[i];
    fmt::format_to(std::back_inserter(text), "{:.3f}\t{:.4f}\t{:.4f}\t{:.5f}\t{:.4f}\t{:.4f}\t{:.5f}\n",
                   team.coverage[i].first, a.x_m, a.y_m, a.theta_rad, b.x_m, b.y_m, b.theta_rad);
  }
  return text;
}

/// Equal digests: every robot decided the same and drove the same way.
std::string digest_of(const RunSetup& setup, std::span<const RunResult> robots, const RunResult& team) {
  std::string text;
  for (const RunResult& robot : robots) text += decisions_text(robot) + poses_text(setup, robot, team);
  return fmt::format("{:016x}", XXH64(text.data(), text.size(), 0));
}

std::vector<types::Vector2> goals_in_building(const RunSetup& setup, const RunResult& result) {
  std::vector<types::Vector2> goals;
  for (const IssuedGoal& goal : result.goals) goals.push_back(setup.plant.start * goal.p_map);
  return goals;
}

json report_of(const JoinedMap& map) {
  return {{"keyframes", map.keyframes},        {"mates_keyframes", map.mates_keyframes},
          {"joined_s", or_null(map.joined_s)}, {"rmse_m", map.error.rmse_m},
          {"worst_m", map.error.worst_m},      {"mates_rmse_m", map.mates_error.rmse_m}};
}

/// Where the time went, and what of it by goals. mean_speed_mps: until 99 % were known.
json time_report(const RunResult& result, double permitted_mps, std::span<const RunResult> robots) {
  json time = json::object(), lost = json::object(), way = json::object();
  for (std::size_t i = 0; i < kDoings; ++i) time[kDoingNames[i]] = rounded(result.time.doing_s[i], 1e-2);
  for (std::size_t i = 0; i < kLosses; ++i) lost[kLossNames[i]] = rounded(result.time.lost_s[i], 1e-2);
  for (std::size_t i = 0; i < RunResult::kShares.size(); ++i)
    way[fmt::format("{:g}", RunResult::kShares[i])] = or_null(result.way_m[i]);
  const auto &t90 = result.reached_s[1], &t99 = result.reached_s[3];
  const bool is_complete = t90 && t99 && *t99 > 0.0;
  const double issued = static_cast<double>(std::max<std::uint64_t>(result.goals_issued, 1));
  double way_m = 0.0;
  for (const RunResult& robot : robots) way_m += robot.way_m.back().value_or(0.0);
  const json speed =
      t99 ? json(rounded(way_m / std::max(*t99 * static_cast<double>(robots.size()), 1e-9), 1e-4))
          : json(nullptr);
  return {{"time_s", time},
          {"lost_s", lost},
          {"way_m", way},
          {"permitted_mps", permitted_mps},
          {"mean_speed_mps", speed},
          {"goals_left_for_another", rounded(static_cast<double>(result.goals_left) / issued, 1e-4)},
          {"last_share_of_time", is_complete ? json(rounded((*t99 - *t90) / *t99, 1e-4)) : json(nullptr)}};
}

json doubts_of(const RunResult& result) {
  json doubts = json::object();
  for (std::size_t i = 0; i < result.doubts.size(); ++i) {
    if (result.doubts[i] > 0) doubts[std::string(plausibility::doubt_texts()[i].name)] = result.doubts[i];
  }
  return doubts;
}

/// The part that reports of robots and of teams share. `result`: of the robot, or the sum over the team.
json common_report(const RunTitle& title, const RunSetup& setup, const RunResult& result,
                   double reachable_m2) {
  return {{"world", title.world},
          {"strategy", title.strategy},
          {"robots", 1},
          {"seed", title.seed},
          {"fidelity", setup.fidelity == Fidelity::kFull ? "full" : "plan"},
          {"finish", title.finish},
          {"radio", title.radio},
          {"reachable_m2", rounded(reachable_m2, 1e-3)},
          {"t50_s", or_null(result.reached_s[0])},
          {"t90_s", or_null(result.reached_s[1])},
          {"t95_s", or_null(result.reached_s[2])},
          {"t99_s", or_null(result.reached_s[3])},
          {"t_home_s", or_null(result.home_s)},
          {"limit_s", setup.limit_s},
          {"distance_m", {result.distance_m}},
          {"goals_issued", result.goals_issued},
          {"clusters_sum", result.clusters_sum},
          {"goals_sum", result.goals_sum},
          {"decisions", result.decisions_made},
          {"decision_ms", quantiles_ms(result.decision_ms)},
          {"planning_ms", quantiles_ms(result.planning_ms)},
          {"collisions", result.collisions},
          {"home", {result.home}},
          {"home_distance_m", result.home_distance_m},
          {"end_s", result.end_s},
          {"ended_as", std::string(to_text(result.activity))},
          {"reason", result.reason},
          {"covered", result.coverage.empty() ? 0.0 : result.coverage.back().second},
          {"free", result.free_fraction},
          {"t_free_s",
           {or_null(result.free_s[0]), or_null(result.free_s[1]), or_null(result.free_s[2]),
            or_null(result.free_s[3])}},
          {"ate_rmse_m", ate_rmse_m(setup, result)},
          {"speedup_over_real_time", result.end_s / std::max(result.wall_s, 1e-9)},
          {"speedup_by_cpu_time", result.end_s / std::max(result.cpu_s, 1e-9)},
          {"cpu_s", result.cpu_s},
          {"wall_s",
           {{"all", result.wall_s},
            {"simulation", result.spent.simulation_s},
            {"mapping", result.spent.mapping_s},
            {"planning", result.spent.planning_s},
            {"control", result.spent.control_s},
            {"measuring", result.spent.measuring_s}}},
          {"doubts", doubts_of(result)},
          {"worst_lag_s", result.worst_lag_s},
          {"coverage", coverage_list(result)}};
}

}  // namespace

json report_of(const RunTitle& title, const RunSetup& setup, const RunResult& result, double reachable_m2) {
  json report = common_report(title, setup, result, reachable_m2);
  report["digest"] = digest_of(setup, {&result, 1}, result);
  report.update(time_report(result, setup.mind.control.limits.v_max_mps, {&result, 1}));
  return report;
}

json team_report_of(const RunTitle& title, const TeamSetup& setup, const TeamResult& result,
                    double reachable_m2) {
  json report = common_report(title, setup.run, result.team, reachable_m2);
  report["robots"] = setup.robots;
  report["digest"] = digest_of(setup.run, result.robots, result.team);
  report.update(time_report(result.team, setup.run.mind.control.limits.v_max_mps, result.robots));
  report["overlap"] = rounded(result.overlap, 1e-4);
  report["maps"] = json::array();
  for (const JoinedMap& map : result.maps) report["maps"].push_back(report_of(map));
  for (const char* key : {"distance_m", "home", "ended_as", "reason"}) report[key] = json::array();
  for (const RunResult& robot : result.robots) {
    report["distance_m"].push_back(robot.distance_m);
    report["home"].push_back(robot.home);
    report["ended_as"].push_back(std::string(to_text(robot.activity)));
    report["reason"].push_back(robot.reason);
  }
  return report;
}

types::Status write_run_files(const std::filesystem::path& folder, const sim::World& world,
                              const RunSetup& setup, const RunResult& result, const sim::Raster& visible) {
  const auto goals = goals_in_building(setup, result);
  const sim::Picture picture = overview(world, {visible, result.covered, result.truth, goals});
  if (auto saved = picture.save_png(folder / "explore.png"); !saved) return saved;
  if (auto saved = coverage_picture(result).save_png(folder / "coverage.png"); !saved) return saved;
  if (auto saved = daemon::write_file((folder / "decisions.txt").string(), decisions_text(result)); !saved)
    return saved;
  return daemon::write_file((folder / "poses.tsv").string(), poses_text(setup, result, result));
}

types::Status write_team_files(const std::filesystem::path& folder, const sim::World& world,
                               const TeamSetup& setup, const TeamResult& result, const sim::Raster& visible) {
  std::vector<std::vector<sim::Se2>> mates;
  for (std::size_t i = 1; i < result.robots.size(); ++i) mates.push_back(result.robots[i].truth);
  const sim::Picture picture =
      overview(world, {visible, result.team.covered, result.robots.front().truth, {}, mates});
  if (auto saved = picture.save_png(folder / "explore.png"); !saved) return saved;
  if (auto saved = coverage_picture(result.team).save_png(folder / "coverage.png"); !saved) return saved;
  for (std::size_t i = 0; i < result.robots.size(); ++i) {
    const RunResult& robot = result.robots[i];
    const auto decisions = folder / fmt::format("decisions-{}.txt", i);
    const auto poses = folder / fmt::format("poses-{}.tsv", i);
    if (auto saved = daemon::write_file(decisions.string(), decisions_text(robot)); !saved) return saved;
    if (auto saved = daemon::write_file(poses.string(), poses_text(setup.run, robot, result.team)); !saved)
      return saved;
  }
  return {};
}

}  // namespace topo::bench
