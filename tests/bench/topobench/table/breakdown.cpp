// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/breakdown.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace topo::bench {
namespace {

using nlohmann::json;

constexpr const char* kBreakdownMeaning =
    "Shares of the missions' time, of all robots. Speed: until 99 % were known. Lost: what the way at the "
    "permitted "
    "speed\nwould have saved, the three largest reasons. Left: share of goals left for another. Over twice: "
    "share of "
    "narrow squares\nof 2 m passed more than twice. Last 9 %: share of the time to 99 % from 90 % on. Way "
    "over bound: "
    "until 99 %, the robot\nwith the longest way, over tours with full knowledge that were found, geometric "
    "mean [95 % "
    "by bootstrap over worlds]\n(runs that knew 99 %); in round brackets over the lower bound, which no team "
    "can "
    "reach.\n";

std::optional<double> number_at(const json& object, const char* key) {
  if (!object.is_object() || !object.contains(key) || !object[key].is_number()) return std::nullopt;
  return object[key].get<double>();
}

template <std::size_t N>
bool take_all(const json& report, const char* key, const std::array<const char*, N>& names,
              std::array<double, N>& out) {
  if (!report.contains(key)) return false;
  for (std::size_t i = 0; i < N; ++i) {
    const auto value = number_at(report[key], names[i]);
    if (!value) return false;
    out[i] = *value;
  }
  return true;
}

/// Mean of those that are there.
struct Mean {
  double sum = 0.0, n = 0.0;
  void add(const std::optional<double>& value) {
    if (!value) return;
    sum += *value;
    n += 1.0;
  }
  [[nodiscard]] double get() const { return n > 0.0 ? sum / n : 0.0; }
};

/// The three largest.
std::string losses_text(const Breakdown& row) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < kLosses; ++i) order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return row.lost[a] > row.lost[b]; });
  std::string text;
  for (std::size_t i = 0; i < 3; ++i)
    text += fmt::format("{}{} {:.0f} %", i > 0 ? ", " : "", kLossNames[order[i]], 100.0 * row.lost[order[i]]);
  return text;
}

std::string ratio_text(const Breakdown& row) {
  const PairedRatio& r = row.over_bound;
  if (r.pairs == 0) return "-";
  const std::string interval = std::isfinite(r.bootstrap.high)
                                   ? fmt::format("{:.2f} to {:.2f}", r.bootstrap.low, r.bootstrap.high)
                                   : "-";
  return fmt::format("{:.2f} [{}] ({:.2f}), {} runs", r.ratio, interval, row.over_lower.ratio, r.pairs);
}

json json_of(const PairedRatio& r) {
  json out{{"ratio", r.ratio}, {"runs", r.pairs}, {"worlds", r.worlds}, {"bootstrap", nullptr}};
  if (std::isfinite(r.bootstrap.high)) out["bootstrap"] = {r.bootstrap.low, r.bootstrap.high};
  return out;
}

}  // namespace

std::optional<RunBreakdown> breakdown_of(const json& report) {
  RunBreakdown out;
  if (!take_all(report, "time_s", kDoingNames, out.time.doing_s) ||
      !take_all(report, "lost_s", kLossNames, out.time.lost_s))
    return std::nullopt;
  const auto left = number_at(report, "goals_left_for_another");
  if (!left || !report.contains("way_m") || !report.contains("corridors_crossed")) return std::nullopt;
  out.goals_left = *left;
  out.way99_m = number_at(report["way_m"], "0.99");
  out.mean_speed_mps = number_at(report, "mean_speed_mps");
  out.last_share_of_time = number_at(report, "last_share_of_time");
  const auto squares = number_at(report["corridors_crossed"], "squares"),
             often = number_at(report["corridors_crossed"], "over_twice");
  if (squares && often && *squares > 0.0) out.crossed_over_twice = *often / *squares;
  return out;
}

Breakdown breakdown_of(const Entrant& entrant, std::span<const BrokenDown> runs, const Bounds& bounds) {
  Breakdown out;
  out.entrant = entrant;
  std::vector<Pair> over_bound, over_lower;
  Mean speed, last, left, crossed;
  TimeSpent all;
  for (const BrokenDown& run : runs) {
    if (run.entrant != entrant) continue;
    ++out.runs;
    all += run.parts.time;
    speed.add(run.parts.mean_speed_mps);
    last.add(run.parts.last_share_of_time);
    left.add(run.parts.goals_left);
    crossed.add(run.parts.crossed_over_twice);
    const auto bound = bounds.find({run.world, run.seed, entrant.robots});
    if (bound == bounds.end() || !run.parts.way99_m || !(*run.parts.way99_m > 0.0)) continue;
    if (bound->second.way_m > 0.0) over_bound.push_back({run.world, *run.parts.way99_m, bound->second.way_m});
    if (bound->second.lower_m > 0.0)
      over_lower.push_back({run.world, *run.parts.way99_m, bound->second.lower_m});
  }
  const double all_s = std::max(all.all_s(), 1e-9);
  for (std::size_t i = 0; i < kDoings; ++i) out.doing[i] = all.doing_s[i] / all_s;
  for (std::size_t i = 0; i < kLosses; ++i) out.lost[i] = all.lost_s[i] / all_s;
  out.mean_speed_mps = speed.get();
  out.last_share_of_time = last.get();
  out.goals_left = left.get();
  out.crossed_over_twice = crossed.get();
  out.over_bound = paired_ratio(over_bound);
  out.over_lower = paired_ratio(over_lower);
  return out;
}

std::string text_of(std::span<const Breakdown> rows) {
  if (std::all_of(rows.begin(), rows.end(), [](const Breakdown& row) { return row.runs == 0; })) return {};
  std::string text = fmt::format(
      "\n## Where the time goes\n\n{}\n| robots x strategy | full speed | slower | turning | standing | "
      "waiting | m/s | lost | "
      "left | over twice | last 9 % | way over bound |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      kBreakdownMeaning);
  auto out = std::back_inserter(text);
  for (const Breakdown& row : rows) {
    if (row.runs == 0) continue;
    fmt::format_to(out, "| {} |", name_of(row.entrant));
    for (const double share : row.doing) fmt::format_to(out, " {:.0f} % |", 100.0 * share);
    fmt::format_to(out, " {:.2f} | {} | {:.0f} % | {:.0f} % | {:.0f} % | {} |\n", row.mean_speed_mps,
                   losses_text(row), 100.0 * row.goals_left, 100.0 * row.crossed_over_twice,
                   100.0 * row.last_share_of_time, ratio_text(row));
  }
  return text;
}

json json_of(const Breakdown& row) {
  json doing = json::object(), lost = json::object();
  for (std::size_t i = 0; i < kDoings; ++i) doing[kDoingNames[i]] = row.doing[i];
  for (std::size_t i = 0; i < kLosses; ++i) lost[kLossNames[i]] = row.lost[i];
  return {{"strategy", row.entrant.strategy},
          {"robots", row.entrant.robots},
          {"radio", row.entrant.radio},
          {"runs", row.runs},
          {"time", doing},
          {"lost", lost},
          {"mean_speed_mps", row.mean_speed_mps},
          {"goals_left_for_another", row.goals_left},
          {"crossed_over_twice", row.crossed_over_twice},
          {"last_share_of_time", row.last_share_of_time},
          {"way_over_bound", json_of(row.over_bound)},
          {"way_over_lower_bound", json_of(row.over_lower)}};
}

}  // namespace topo::bench
