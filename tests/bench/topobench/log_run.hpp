// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/pipeline/mapping_step.hpp"
#include "daemon/carmen/carmen_log.hpp"
#include "daemon/carmen/relations.hpp"

namespace topo::bench {

/// How a log was mapped: the same pure steps as the daemon's threads, in lock-step. A loop answer is handed
/// over exactly `answer_delay` keyframes after its question, so that runs repeat.
struct LogRunOptions {
  std::size_t answer_delay = 2;
};

/// What a run over a log produced, with the time each scan cost.
struct LogRun {
  std::vector<daemon::TimedPose> trajectory;  ///< robot in map, every scan, corrected, log's own stamps
  std::vector<double> match_ms;               ///< wall time of each mapping step
  std::vector<double> closure_ms;             ///< wall time of each loop search
  int closures_accepted = 0;
  int closures_rejected = 0;
  int lost = 0;      ///< scans placed by odometry alone
  int searched = 0;  ///< scans that needed the correlative search
  double path_m = 0.0;
  double cpu_s = 0.0;
  double wall_s = 0.0;
};

/// Maps a whole log. `state` holds the map afterwards.
LogRun run_log(const daemon::CarmenLog& log, pipeline::MappingState& state, const LogRunOptions& options);

/// A log of either kind: Mines logs are tables of numbers (MANIFEST of the data), everything else is CARMEN
/// text.
types::Result<daemon::CarmenLog> read_log(const std::string& path);

/// A log's scan as the mapper takes it: all beams at one instant.
void fill_scan(const daemon::CarmenScan& from, std::uint64_t sequence, types::Scan& to);

/// Mapper parameters for a log: the tree's defaults and the laser's place on that robot.
slam::MapperParams params_for(const daemon::CarmenLog& log);

}  // namespace topo::bench
