// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/types/result.hpp"
#include "tests/bench/topobench/judge/path_error.hpp"
#include "tests/bench/topobench/slam/lock_step.hpp"
#include "tests/sim/simulation.hpp"
#include "tests/sim/way_point_drive.hpp"

namespace topo::bench {

/// A person at the joystick drives a simulated Pioneer with a UTM-30LX (1081 beams, 40 Hz) on a patrol
/// through a building, at the stated difficulty.
struct SimulatedSetup {
  double minutes = 30.0;
  std::uint64_t seed = 1;
  int people = 0;  ///< who walk about in the building
  sim::WayPointDrive::Limits limits{.arrived_m = 0.10};
};

struct SimulatedRun {
  MappingRun run;
  std::vector<PosePair> corrected, live;  ///< one a scan
  double path_m = 0.0;                    ///< driven, by the truth
  double odometry_m = 0.0;                ///< how far dead reckoning alone is off at the end
  std::uint64_t collisions = 0;
  std::size_t scans = 0;
};

/// The mapper's parameters for that robot: the tree's defaults and the laser's place.
slam::MapperParams simulated_robot_params();

/// Runs it in lock-step, faster than real time. `state` holds the map afterwards. Status packets arrive 20 to
/// 60 ms late and are stamped as the Pioneer driver does. Fails when the robot cannot drive from the
/// building's start.
types::Result<SimulatedRun> run_simulated(sim::Simulation& simulation, const SimulatedSetup& setup,
                                          pipeline::MappingState& state);

}  // namespace topo::bench
