// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "core/slam/params.hpp"
#include "core/types/result.hpp"
#include "core/types/robot_limits.hpp"
#include "core/types/wheel_calibration.hpp"
#include "tests/bench/topobench/explore/readings.hpp"
#include "tests/sim/simulation.hpp"

namespace topo::bench {

constexpr double kFrontHeight_m = 0.30;  ///< of the level laser, as config/simulation.toml has it

/// What lies between the firmware and the robot's mind: the driver, and what it is told of this robot.
struct DriverSetup {
  types::WheelCalibration wheels;  ///< as configured; those of the model: nothing is corrected
  types::Duration status_delay{};  ///< of status packets, beyond what the driver can observe
  types::Duration told_delay{};    ///< as configured
};

struct PlantSetup {
  sim::Se2 start;
  std::optional<sim::Se2> T_building_map;  ///< where the map has its origin, if it is not the start
  slam::MapperParams mapping;              ///< where the scanners are
  types::RobotLimits limits;
  types::Duration firmware_watchdog = std::chrono::milliseconds(2000);
  sim::Difficulty difficulty;
  std::uint64_t seed = 1;
  DriverSetup driver;  ///< of fidelity full alone
};

/// The building with the robot's body and devices in it: takes commands, gives readings. What it knows of the
/// truth is for measuring and pictures alone. Not thread-safe.
class Plant {
 public:
  /// Of one tick: a whole part of every period that is simulated.
  static constexpr sim::SimTime kTick = std::chrono::milliseconds(5);

  virtual ~Plant() = default;
  /// Goes on by one tick and adds what arrived in it.
  virtual void tick(Readings& out) = 0;
  virtual void command(const types::BaseCommand& command) = 0;

  [[nodiscard]] virtual sim::SimTime now() const = 0;
  [[nodiscard]] virtual const sim::World& world() const = 0;
  [[nodiscard]] virtual sim::RobotBody& body() = 0;
};

/// Every scan of two UTM-30LX at 40 Hz, sonar, bumpers, status packets at 10 Hz, which arrive 40 ms after
/// what they tell of; steps of 1 ms.
types::Result<std::unique_ptr<Plant>> make_full_plant(sim::World world, const PlantSetup& setup);

/// The same in a simulation that several robots share, which has the seed and the difficulty. Its time is
/// everybody's: whoever ticks first moves all, and all tick before the first ticks again.
types::Result<std::unique_ptr<Plant>> make_full_plant(std::shared_ptr<sim::Simulation> simulation,
                                                      const PlantSetup& setup);

/// The same robot with scans of 270 beams at 5 Hz that have no noise, and the true pose with a bounded error
/// in place of a mapper; steps of 5 ms.
/// Several robots may be in one world.
types::Result<std::unique_ptr<Plant>> make_sparse_plant(std::shared_ptr<sim::World> world,
                                                        const PlantSetup& setup);

}  // namespace topo::bench
