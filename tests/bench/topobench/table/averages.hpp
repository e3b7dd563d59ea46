// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/types/result.hpp"
#include "tests/bench/topobench/table/breakdown.hpp"
#include "tests/bench/topobench/table/contest.hpp"
#include "tests/bench/topobench/table/paired_ratio.hpp"
#include "tests/bench/topobench/table/run_key.hpp"

namespace topo::bench {

/// The times of a run that are compared.
enum class Time : std::uint8_t { kT50, kT90, kT95, kT99, kHome };
inline constexpr std::size_t kTimes = 5;
inline constexpr std::array<const char*, kTimes> kTimeNames{"t50", "t90", "t95", "t99", "t_home"};

/// One exploration of a table.
struct TableRun {
  std::string world;
  std::uint64_t seed = 1;
  types::Se2 start;
  Entrant entrant;
  /// The limit where it failed: in all when a robot collided or is not home at the end, and in each whose
  /// share it did not reach; kHome is of what `finished_share` says. For everybody alike.
  std::array<double, kTimes> times_s{};
  bool failed = false;   ///< kHome is
  std::string why;       ///< it failed
  bool crashed = false;  ///< there is no report: what follows is not known, but nobody came home
  int robots_not_home = 0;
  std::uint64_t collisions = 0;
  double distance_m = 0.0;        ///< of all robots together
  std::optional<double> overlap;  ///< of several robots
  double decision_p99_ms = 0.0;
  std::vector<std::pair<double, double>> coverage;  ///< seconds and share
  std::optional<RunBreakdown> parts;
};

/// Of a report as REPORTS "topobench explore" has it. `finished_share`: the one of kT50 to kT99 whose share a
/// robot must have reached that comes home with its work done. An error names the key of the report that is
/// missing or no such thing.
types::Result<TableRun> table_run_of(const RunKey& key, const nlohmann::json& report, Time finished_share);

/// One that left no report.
TableRun crashed_run(const RunKey& key, std::string why);

/// What the runs of one entrant come to.
struct Average {
  Entrant entrant;
  std::size_t runs = 0;
  std::size_t failed = 0;
  std::array<double, kTimes> times_s{};  ///< means, failures with their limit
  std::array<double, kTimes> worst_s{};
  double distance_m = 0.0;  ///< mean of those that did not crash, as what follows
  std::optional<double> overlap;
  double decision_p99_ms = 0.0, decision_p99_worst_ms = 0.0;
  std::uint64_t collisions = 0;  ///< sum
  int robots_not_home = 0;       ///< sum
};

/// Of an entrant. The order of the runs does not matter. Without runs all is 0.
Average average_of(const Entrant& entrant, std::span<const TableRun> runs);

/// One entrant's times against another's, over the same world and seed (and with it start).
struct Comparison {
  Contest contest;
  std::array<PairedRatio, kTimes> ratios;  ///< times of a, of those of b: less than 1 is faster
};

/// Of several opponents each world takes the one whose mean time there is the least, of every time anew. The
/// order of the runs does not matter: they are paired, and taken by world and seed; what one of the contest
/// has not is left out.
Comparison compare(std::span<const TableRun> runs, const Contest& contest);

}  // namespace topo::bench
