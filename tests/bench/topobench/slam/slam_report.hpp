// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tests/bench/topobench/slam/simulated_run.hpp"

namespace topo::bench {

/// The keys of REPORTS "topobench slam" that every run has: closures, path, cost by stage.
nlohmann::json report_of(const pipeline::MappingState& state, const MappingRun& run);

/// Error of a path against the truth, with the map laid on the building as fits best, and by its first pose
/// alone: what a user sees who knows where the robot began.
nlohmann::json error_report(std::span<const PosePair> pairs);

/// Length of the path, as the map has it.
double path_length_m(const MappingRun& run);

}  // namespace topo::bench
