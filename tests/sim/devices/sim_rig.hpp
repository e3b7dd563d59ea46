// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/types/result.hpp"
#include "tests/sim/devices/control_server.hpp"
#include "tests/sim/devices/rig_config.hpp"
#include "tests/sim/devices/robot_rig.hpp"
#include "tests/sim/devices/truth_recorder.hpp"
#include "tests/sim/simulation.hpp"

namespace topo::sim {

/// Ground truth, for tests only.
struct Truth {
  types::Se2 pose;               ///< T_building_base
  std::uint64_t collisions = 0;  ///< contacts begun since the start
  double path_m = 0.0;
  double steady_s = 0.0;  ///< on CLOCK_MONOTONIC
  double sim_s = 0.0;     ///< since the simulation's start
};

/// A building, its robots and their devices, in real time, in one thread. Not thread-safe: sim_harness.hpp
/// runs one in its own thread.
class SimRig {
 public:
  /// Places the robots and opens every wire. Errors name the cause; nothing remains open then.
  static types::Result<std::unique_ptr<SimRig>> create(World world, const RigConfig& config);

  /// One cycle: steps up to the present time, moves bytes, answers the control socket, then waits for the
  /// next millisecond or the first byte.
  void iterate();

  [[nodiscard]] Simulation& simulation() { return simulation_; }
  [[nodiscard]] RobotRig& robot(std::size_t i) { return *robots_[i]; }
  [[nodiscard]] std::size_t robot_count() const { return robots_.size(); }
  [[nodiscard]] SimTime now() const { return now_; }
  [[nodiscard]] Truth truth(std::size_t robot) const;
  /// Cycles that began more than 20 ms late, and the time that the simulation had to skip.
  [[nodiscard]] std::uint64_t overruns() const { return overruns_; }
  [[nodiscard]] double lost_s() const { return lost_s_; }
  /// CLOCK_MONOTONIC at the simulation's start (moves by lost_s()).
  [[nodiscard]] double epoch_s() const;
  [[nodiscard]] const RigConfig& config() const { return config_; }

 private:
  using Clock = std::chrono::steady_clock;

  SimRig(World world, const RigConfig& config);
  types::Status place_robots();
  void catch_up();
  void wait();

  RigConfig config_;
  std::vector<std::unique_ptr<RobotRig>> robots_;
  Simulation simulation_;  // after robots_: it must be destroyed first
  TruthRecorder truth_;
  std::unique_ptr<ControlServer> control_;
  Clock::time_point epoch_;
  SimTime now_{0};
  std::uint64_t overruns_ = 0;
  double lost_s_ = 0.0;
  std::vector<pollfd> fds_;
};

}  // namespace topo::sim
