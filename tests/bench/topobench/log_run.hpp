// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "tests/bench/carmen/carmen_log.hpp"
#include "tests/bench/topobench/slam/lock_step.hpp"

namespace topo::bench {

/// Maps a whole log. `state` holds the map afterwards. The stamps are the log's own.
MappingRun run_log(const CarmenLog& log, pipeline::MappingState& state);

/// Options of a log by START and STEP of its beams in degrees; none when `beams_deg` is empty.
LogOptions options_of(std::span<const double> beams_deg);

/// A log of either kind: Mines logs are tables of numbers (MANIFEST of the data), everything else is CARMEN
/// text.
types::Result<CarmenLog> read_log(const std::string& path, const LogOptions& options = {});

/// Prints the remarks on a log to standard error, a line each.
void print_remarks(const std::string& path, const CarmenLog& log);

/// A log's scan as the mapper takes it, its last beam at `stamp_s`.
void fill_scan(const CarmenScan& from, double stamp_s, std::uint64_t sequence, types::Scan& to);

/// Mapper parameters for a log: the tree's defaults and the laser's place on that robot.
slam::MapperParams params_for(const CarmenLog& log);

}  // namespace topo::bench
