// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tests/sim/devices/arcos_device.hpp"
#include "tests/sim/devices/rig_config.hpp"
#include "tests/sim/devices/scip_device.hpp"
#include "tests/sim/devices/wire.hpp"
#include "tests/sim/simulation.hpp"

namespace topo::sim {

/// One robot's devices between its body in the simulation and its three wires. Not thread-safe.
class RobotRig final : public WheelDrive, public SensorSink {
 public:
  RobotRig(const RobotConfig& config, std::size_t number, std::uint64_t seed);
  RobotRig(const RobotRig&) = delete;
  RobotRig& operator=(const RobotRig&) = delete;
  ~RobotRig() override = default;

  /// The robot's data for the simulation.
  [[nodiscard]] RobotSetup setup(const types::Se2& start);
  types::Status open();
  void pump(SimTime now);
  void append_poll(std::vector<pollfd>& fds) const;

  WheelSpeeds wheel_speeds(SimTime now, SimTime dt, const RobotBody& body) override;
  void on_sweep(std::size_t laser, const Sweep& sweep) override;
  void on_sonar(const SonarEcho& echo) override;

  [[nodiscard]] ArcosDevice& base() { return base_; }
  [[nodiscard]] ScipDevice& laser(DeviceId id) { return *lasers_[static_cast<std::size_t>(id)]; }
  [[nodiscard]] Wire& wire(DeviceId id) { return *wires_[static_cast<std::size_t>(id)]; }
  [[nodiscard]] const std::string& laser_serial(DeviceId id) const {
    return lasers_[static_cast<std::size_t>(id)]->serial();
  }
  /// The two scanners at each other's plug, with their serial numbers, in mid-stream; again: as before.
  void exchange_scanners();
  /// From the next connection on another device of the same kind, by its name and serial number; or the own.
  void set_foreign(DeviceId id, bool foreign);
  [[nodiscard]] const RobotConfig& config() const { return config_; }

 private:
  RobotConfig config_;
  std::size_t number_;
  std::uint64_t seed_;
  ArcosDevice base_;
  std::array<std::string, 2> serials_;  ///< as they were built in
  bool exchanged_ = false;
  std::array<std::unique_ptr<ScipDevice>, 2> lasers_;
  std::array<std::unique_ptr<Wire>, kDeviceCount> wires_;
  scip::Turn turn_;
};

}  // namespace topo::sim
