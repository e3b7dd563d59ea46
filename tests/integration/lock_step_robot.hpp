// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "drivers/io/byte_stream.hpp"
#include "tests/sim/devices/arcos_device.hpp"
#include "tests/sim/devices/scip_device.hpp"
#include "tests/sim/simulation.hpp"

namespace topo::test {

/// What a robot of lock-step is made of.
struct LockStepSetup {
  std::string model = "p3dx";  ///< or p3at
  sim::LaserMount front{};
  bool has_front = true;
  sim::Difficulty difficulty;
};

/// A simulated robot whose base and front scanner speak their protocols, byte by byte, in the time of the
/// simulation: reading from a wire lets that time pass. One thread; as fast as the machine is.
class LockStepRobot final : public sim::WheelDrive, public sim::SensorSink {
 public:
  LockStepRobot(sim::World world, const LockStepSetup& setup, std::uint64_t seed);
  ~LockStepRobot() override;
  LockStepRobot(const LockStepRobot&) = delete;
  LockStepRobot& operator=(const LockStepRobot&) = delete;

  /// The robot must outlive the connectors and their streams.
  [[nodiscard]] std::unique_ptr<io::Connector> base_connector();
  [[nodiscard]] std::unique_ptr<io::Connector> front_connector();
  [[nodiscard]] const sim::RobotBody& body() const { return simulation_.body(0); }
  [[nodiscard]] types::Stamp now() const { return types::Stamp{simulation_.now()}; }
  void advance_to(types::Stamp time);

  sim::WheelSpeeds wheel_speeds(sim::SimTime now, sim::SimTime dt, const sim::RobotBody& body) override;
  void on_sweep(std::size_t laser, const sim::Sweep& sweep) override;
  void on_sonar(const sim::SonarEcho&) override {}

  /// Bytes that have arrived at the host's end.
  struct Arrived {
    types::Stamp stamp{};
    std::string bytes;
  };
  /// One wire with the device at its end.
  struct Line {
    sim::WireDevice* device = nullptr;
    std::deque<Arrived> arrived;
  };

 private:
  void deliver(Line& line);

  sim::Simulation simulation_;
  sim::ArcosDevice base_;
  sim::ScipDevice front_;
  Line base_line_, front_line_;
  sim::scip::Turn turn_;
};

}  // namespace topo::test
