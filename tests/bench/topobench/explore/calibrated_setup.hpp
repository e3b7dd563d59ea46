// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

#include "tests/bench/topobench/explore/explore_run.hpp"

namespace topo::bench {

/// "right", "found", "none": how a robot of `topobench calibrate` is configured.
std::vector<std::string> calibration_names();

/// An exploration by the robot of `topobench calibrate` of this seed, in fidelity full: with the
/// configuration that is right, with that which setup and calibration found, or as it is after setup alone.
types::Result<RunSetup> calibrated_setup(std::string_view name, const sim::Se2& start, std::uint64_t seed);

}  // namespace topo::bench
