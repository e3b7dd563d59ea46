// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tests/bench/carmen/relations.hpp"

namespace topo::bench {

/// Where the robot believed to be in its map, and where it was in the building.
struct PosePair {
  types::Se2 T_map_base;
  types::Se2 T_building_base;
};

/// The poses of an estimated path for whose stamps there is a truth.
std::vector<PosePair> pair_up(std::span<const TimedPose> estimate, std::span<const TimedPose> truth);

struct PathError {
  double rmse_m = 0.0;
  double worst_m = 0.0;
};

/// Distances with the map laid on the building by the given transform (absolute trajectory error, Sturm et
/// al. 2012). Zero without pairs.
PathError path_error(std::span<const PosePair> pairs, const types::Se2& T_building_map);

/// The rigid motion that lays the path on the truth with the least squared distances (Horn 1987, in the
/// plane). Identity without pairs.
types::Se2 best_fit(std::span<const PosePair> pairs);

}  // namespace topo::bench
