// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "tests/bench/topobench/explore/time_book.hpp"
#include "tests/bench/topobench/table/paired_ratio.hpp"
#include "tests/bench/topobench/table/run_key.hpp"

namespace topo::bench {

/// What of a run's report says where its time went. Runs of older programs have none.
struct RunBreakdown {
  TimeSpent time;                            ///< sum over robots
  std::optional<double> way99_m;             ///< of the robot with the longest, until 99 % were known
  std::optional<double> mean_speed_mps;      ///< until then
  std::optional<double> last_share_of_time;  ///< from 90 to 99 %
  double goals_left = 0.0;                   ///< share left for another
  double crossed_over_twice = 0.0;           ///< share of narrow squares
};

/// Nothing when the report has not all of the keys.
std::optional<RunBreakdown> breakdown_of(const nlohmann::json& report);

/// One run's, with whose and where.
struct BrokenDown {
  std::string world;
  std::uint64_t seed = 1;
  Entrant entrant;
  RunBreakdown parts;
};

/// World, seed (with it the start) and number of robots.
using BoundKey = std::tuple<std::string, std::uint64_t, int>;
struct KnownBound {
  double way_m = 0.0, lower_m = 0.0;  ///< for 99 %, of the robot with the longest way
};
using Bounds = std::map<BoundKey, KnownBound>;

/// Means over the runs of one entrant.
struct Breakdown {
  Entrant entrant;
  std::size_t runs = 0;
  std::array<double, kDoings> doing{};                    ///< shares of the time
  std::array<double, kLosses> lost{};                     ///< shares of the time
  double mean_speed_mps = 0.0, last_share_of_time = 0.0;  ///< of those that knew 99 %
  double goals_left = 0.0, crossed_over_twice = 0.0;
  PairedRatio over_bound,
      over_lower;  ///< ways until 99 % were known, over the bounds; pairs: runs that have both
};
Breakdown breakdown_of(const Entrant& entrant, std::span<const BrokenDown> runs, const Bounds& bounds);

/// Markdown, with what the columns mean. Empty without runs.
std::string text_of(std::span<const Breakdown> rows);
nlohmann::json json_of(const Breakdown& row);

}  // namespace topo::bench
