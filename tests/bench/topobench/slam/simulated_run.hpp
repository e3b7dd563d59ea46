// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "core/types/result.hpp"
#include "tests/bench/topobench/explore/plant.hpp"
#include "tests/bench/topobench/judge/path_error.hpp"
#include "tests/bench/topobench/slam/lock_step.hpp"
#include "tests/bench/topobench/slam/thinned_log.hpp"
#include "tests/sim/simulation.hpp"
#include "tests/sim/way_point_drive.hpp"

namespace topo::bench {

/// The mapper's parameters for the simulated robot: the tree's defaults and the laser's place.
slam::MapperParams simulated_robot_params();

/// A person at the joystick drives a simulated Pioneer with a UTM-30LX (1081 beams, 40 Hz) on a patrol
/// through a building, at the stated difficulty.
struct SimulatedSetup {
  double minutes = 30.0;
  std::uint64_t seed = 1;
  int people = 0;  ///< who walk about in the building
  sim::WayPointDrive::Limits limits{.arrived_m = 0.10};
  Thinning thinning{};                                              ///< of the scans that the mapper gets
  types::Se2 T_base_laser = simulated_robot_params().T_base_laser;  ///< where the laser is in truth
  /// Status packets through this driver; nothing: 20 to 60 ms late, and stamped as the Pioneer driver
  /// estimates them.
  std::optional<DriverSetup> driver{};
};

struct SimulatedRun {
  MappingRun run;
  std::vector<PosePair> corrected, live;  ///< one a scan
  double path_m = 0.0;                    ///< driven, by the truth
  double odometry_m = 0.0;                ///< how far dead reckoning alone is off at the end
  std::uint64_t collisions = 0;
  std::size_t scans = 0;
};

/// Runs it in lock-step, faster than real time. `state` holds the map afterwards. The drive depends
/// on the truth alone, and not on what the driver and the mapper are told. Fails when the robot cannot drive
/// from the building's start.
types::Result<SimulatedRun> run_simulated(sim::Simulation& simulation, const SimulatedSetup& setup,
                                          pipeline::MappingState& state);

}  // namespace topo::bench
