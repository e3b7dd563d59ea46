// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/table_text.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>

namespace topo::bench {
namespace {

using nlohmann::json;

constexpr const char* kMeaning =
    "Times in seconds: the mean over all runs, and the worst. A run in which a robot collided, or is not "
    "home "
    "at the\nend, counts as the limit in all of them, one that did not reach a share in that share's. Way: "
    "of "
    "all robots together.\nOverlap: what at least two robots saw, of what any did. p99: of the time that "
    "decisions took in a run; mean, and worst.\n";
constexpr const char* kWorldMeaning =
    "Means of t95 / t99 / t_home; in brackets how many runs failed, if any.\n";
constexpr const char* kRatioMeaning =
    "Times of A over those of B, paired by world and seed (with it the start): under 1, A is faster. "
    "Geometric mean\n[95 % interval over runs; over worlds; over worlds by bootstrap], the first two by "
    "Student's t on the "
    "logarithms: what more\nruns in these worlds would give, and what other worlds of the kind would (each "
    "world's mean is one value). best_baseline: in each world, for each\ntime, the one with the least mean "
    "there.\n";

constexpr std::array kRatioTimes{Time::kT90, Time::kT95, Time::kT99, Time::kHome};
constexpr const char* kRatiosHead =
    "| A | B | pairs | worlds | t90 | t95 | t99 | t_home |\n|---|---|---|---|---|---|---|---|\n";

std::string text_of(const Interval& interval) {
  return std::isfinite(interval.high) ? fmt::format("{:.2f} to {:.2f}", interval.low, interval.high) : "-";
}

std::string means_head(const std::string& share) {
  return fmt::format(
      "| robots x strategy | runs | {} and home | t50 | t90 | t95 | t99 | t_home | way m | overlap | p99 ms "
      "| "
      "collisions | robots not home |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      share);
}

void add_row(const Average& average, std::string& text) {
  if (average.runs == 0) return;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "| {} | {} | {} |", name_of(average.entrant), average.runs,
                 average.runs - average.failed);
  for (std::size_t i = 0; i < kTimes; ++i)
    fmt::format_to(out, " {:.1f} ({:.0f}) |", average.times_s[i], average.worst_s[i]);
  fmt::format_to(out, " {:.1f} | {} | {:.1f} ({:.1f}) | {} | {} |\n", average.distance_m,
                 average.overlap ? fmt::format("{:.3f}", *average.overlap) : "-", average.decision_p99_ms,
                 average.decision_p99_worst_ms, average.collisions, average.robots_not_home);
}

/// Worlds downwards, entrants across.
void add_worlds(const Table& table, std::string& text) {
  auto out = std::back_inserter(text);
  std::string line = "|---|";
  fmt::format_to(out, "| world |");
  for (const Average& average : table.averages) {
    fmt::format_to(out, " {} |", name_of(average.entrant));
    line += "---|";
  }
  fmt::format_to(out, "\n{}\n", line);
  for (std::size_t i = 0; i < table.worlds.size(); ++i) {
    fmt::format_to(out, "| {} |", table.worlds[i]);
    for (const Average& average : table.by_world[i]) {
      const auto time_s = [&](Time time) { return average.times_s[static_cast<std::size_t>(time)]; };
      if (average.runs == 0)
        fmt::format_to(out, " - |");
      else
        fmt::format_to(out, " {:.0f} / {:.0f} / {:.0f}{} |", time_s(Time::kT95), time_s(Time::kT99),
                       time_s(Time::kHome), average.failed > 0 ? fmt::format(" ({})", average.failed) : "");
    }
    text += '\n';
  }
}

void add_row(const Comparison& comparison, std::string& text) {
  const PairedRatio& any = comparison.ratios.front();
  if (any.pairs == 0) return;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "| {} | {} | {} | {} |", name_of(comparison.contest.a),
                 name_of_opponents(comparison.contest), any.pairs, any.worlds);
  for (const Time time : kRatioTimes) {
    const PairedRatio& r = comparison.ratios[static_cast<std::size_t>(time)];
    fmt::format_to(out, " {:.3f} [{}; {}; {}] |", r.ratio, text_of(r.over_runs), text_of(r.over_worlds),
                   text_of(r.bootstrap));
  }
  text += '\n';
}

void add_failure(const TableRun& run, std::string& text) {
  fmt::format_to(std::back_inserter(text), "- {}, {}, `--seed {} --start {},{},{}`: {}\n", run.world,
                 name_of(run.entrant), run.seed, run.start.x_m, run.start.y_m, run.start.theta_rad, run.why);
}

json json_of(const Entrant& entrant) {
  return {{"strategy", entrant.strategy}, {"robots", entrant.robots}, {"radio", entrant.radio}};
}

json json_of(const Average& average) {
  json out = json_of(average.entrant);
  out["runs"] = average.runs;
  out["failed"] = average.failed;
  for (std::size_t i = 0; i < kTimes; ++i) {
    out[fmt::format("{}_s", kTimeNames[i])] = average.times_s[i];
    out[fmt::format("{}_worst_s", kTimeNames[i])] = average.worst_s[i];
  }
  out["distance_m"] = average.distance_m;
  if (average.overlap) out["overlap"] = *average.overlap;
  out["decision_p99_ms"] = average.decision_p99_ms;
  out["decision_p99_worst_ms"] = average.decision_p99_worst_ms;
  out["collisions"] = average.collisions;
  out["robots_not_home"] = average.robots_not_home;
  return out;
}

json json_of(const Interval& interval) {
  if (!std::isfinite(interval.high)) return nullptr;
  return {interval.low, interval.high};
}

json json_of(const Comparison& comparison) {
  const Contest& contest = comparison.contest;
  json out{{"a", json_of(contest.a)}, {"b", json_of(contest.b.front())}};
  if (contest.b.size() > 1) out["b"]["strategy"] = kBestBaseline;
  for (std::size_t i = 0; i < kTimes; ++i) {
    const PairedRatio& r = comparison.ratios[i];
    out[kTimeNames[i]] = {{"ratio", r.ratio},
                          {"over_runs", json_of(r.over_runs)},
                          {"over_worlds", json_of(r.over_worlds)},
                          {"bootstrap", json_of(r.bootstrap)},
                          {"pairs", r.pairs},
                          {"worlds", r.worlds},
                          {"a_faster", r.a_less}};
  }
  return out;
}

json json_of_failure(const TableRun& run) {
  json out = json_of(run.entrant);
  out["world"] = run.world;
  out["seed"] = run.seed;
  out["start"] = {run.start.x_m, run.start.y_m, run.start.theta_rad};
  out["why"] = run.why;
  return out;
}

template <class Value, class ToJson>
json list_of(const std::vector<Value>& values, ToJson&& to_json) {
  json list = json::array();
  for (const Value& value : values) list.push_back(to_json(value));
  return list;
}

}  // namespace

std::string text_of(const Table& table) {
  std::string text = fmt::format("# Explorations of {} worlds\n\n", table.worlds.size());
  auto out = std::back_inserter(text);
  for (const auto& [key, value] : table.setup.items()) fmt::format_to(out, "{}: {}  \n", key, value.dump());
  fmt::format_to(out, "\n## Means\n\n{}\n{}", kMeaning, means_head(table.share));
  for (const Average& average : table.averages) add_row(average, text);
  fmt::format_to(out, "\n## Ratios\n\n{}\n{}", kRatioMeaning, kRatiosHead);
  for (const Comparison& comparison : table.comparisons) add_row(comparison, text);
  text += text_of(std::span<const Breakdown>(table.breakdowns));
  fmt::format_to(out, "\n## World by world\n\n{}\n", kWorldMeaning);
  add_worlds(table, text);
  fmt::format_to(out, "\n## Failed runs\n\n{}", table.failures.empty() ? "None.\n" : "");
  for (const TableRun& run : table.failures) add_failure(run, text);
  return text;
}

json json_of(const Table& table) {
  const auto of_average = [](const Average& average) { return json_of(average); };
  json by_world = json::object();
  for (std::size_t i = 0; i < table.worlds.size(); ++i)
    by_world[table.worlds[i]] = list_of(table.by_world[i], of_average);
  return {{"worlds", table.worlds},
          {"setup", table.setup},
          {"means", list_of(table.averages, of_average)},
          {"by_world", by_world},
          {"ratios", list_of(table.comparisons, [](const Comparison& c) { return json_of(c); })},
          {"breakdown", list_of(table.breakdowns, [](const Breakdown& row) { return json_of(row); })},
          {"failures", list_of(table.failures, json_of_failure)}};
}

}  // namespace topo::bench
