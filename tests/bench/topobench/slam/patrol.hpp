// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "tests/sim/raster.hpp"

namespace topo::bench {

/// Way points of a long drive through a building, for SLAM to be measured on: from place to place, next
/// always one that was long not visited, each reached by the way that is short and leaves room on both sides.
/// `free` is where nothing stands (1); the way keeps `clearance_min_m` from all else and is at least
/// `length_m` long. The same seed gives the same way. Empty when nothing can be reached from `start`.
std::vector<sim::Vector2> patrol(const sim::Raster& free, const sim::Vector2& start, double clearance_min_m,
                                 double length_m, std::uint64_t seed);

}  // namespace topo::bench
