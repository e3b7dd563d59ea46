// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/analysis/analysis.hpp"
#include "tests/sim/raster.hpp"

namespace topo::bench {

/// What a robot can drive over, by the building's truth.
struct DrivableTruth {
  sim::Raster poses;  ///< 1 where its middle can be (sim::reachable_poses)
  sim::Raster swept;  ///< 1 where any part of it can be
};

/// `poses` with everything within the robot's radius of them.
DrivableTruth drivable_truth(sim::Raster poses, double radius_m);

/// A frontier cluster of at least 0.75 m through which the robot can drive into unexplored space.
struct OpeningOntoSpace {
  types::Vector2 p_map{0.0, 0.0};  ///< of its frontier's cells the one in the middle
  double width_m = 0.0;
  double space_m2 = 0.0;  ///< connected, drivable, unknown to the map
  bool has_goal = false;
  std::string why;  ///< without a goal: what became of the nearest candidate
};

struct OpeningsOntoSpace {
  std::vector<OpeningOntoSpace> openings;
  std::size_t goals = 0;  ///< of the analysis, that are there for one of them
};

/// The openings of a partial map onto at least `space_min_m2` that is really there, with whether the analysis
/// has a goal for each: one whose own opening is on that frontier, or one within 3 m, and in sight, of where
/// a robot would stand for it. `T_building_map`: where the map lies in the building. Costs the building's
/// cells, and the map's for each frontier.
OpeningsOntoSpace openings_onto_space(const analysis::Analysis& analysis, const DrivableTruth& truth,
                                      const types::Se2& T_building_map, double space_min_m2 = 10.0);

}  // namespace topo::bench
