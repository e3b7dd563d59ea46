// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>

#include "core/types/result.hpp"
#include "tests/bench/topobench/table/breakdown.hpp"
#include "tests/bench/topobench/table/run_log.hpp"
#include "tests/bench/topobench/table/table_world.hpp"
#include "tests/bench/topobench/table/worker_processes.hpp"

namespace topo::bench {

/// Bounds with full knowledge (bound/bound.hpp) for every world, start and number of robots, of the log, and
/// where it has none found anew and put there, if `find_missing`. One that cannot be found is left out.
types::Result<Bounds> table_bounds(std::span<const TableWorld> worlds, std::span<const int> robots,
                                   const WorkerLimits& limits, bool find_missing, RunLog& log);

}  // namespace topo::bench
