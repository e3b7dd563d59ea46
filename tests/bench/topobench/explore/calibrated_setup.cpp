// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/calibrated_setup.hpp"

#include "tests/bench/topobench/calibrate/calibrated_robot.hpp"

namespace topo::bench {
namespace {

daemon::Configuration configuration_of(const CalibratedRobot& robot, std::string_view name) {
  if (name == "right") return right_configuration(robot);
  return name == "found" ? robot.configuration : robot.set_up.configuration;
}

}  // namespace

std::vector<std::string> calibration_names() { return {"right", "found", "none"}; }

types::Result<RunSetup> calibrated_setup(std::string_view name, const sim::Se2& start, std::uint64_t seed) {
  const auto robot = calibrated_robot(seed);
  if (!robot) return tl::unexpected(robot.error());
  const daemon::Configuration configuration = configuration_of(*robot, name);
  RunSetup setup = configured_setup(configuration, start, seed, Fidelity::kFull);
  // The body is as it is, whatever is configured; the simulator draws the same wheels from the same seed.
  setup.plant.mapping.T_base_laser = robot->truth.T_base_laser;
  setup.plant.mapping.coronal = robot->truth.coronal;
  setup.plant.difficulty = difficulty_of_its_wheels();
  setup.plant.driver = {configuration.base.wheels, types::from_seconds(robot->truth.delay_s),
                        types::from_seconds(configuration.base.status_delay_s)};
  return setup;
}

}  // namespace topo::bench
