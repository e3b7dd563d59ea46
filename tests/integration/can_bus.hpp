// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tests/sim/devices/file_descriptor.hpp"
#include "tests/sim/devices/rig_config.hpp"

namespace topo::test {

/// Where the driver is and where the robot: the same virtual interface, or two controllers on one bus.
struct CanPair {
  std::string driver, robot;
  /// "vcan0", or "can0_can1": fit to be a part of a test's name.
  [[nodiscard]] std::string name() const { return driver == robot ? driver : driver + "_" + robot; }
};

/// From TOPOMETRIC_CAN, "vcan0 vcan1": a robot can be driven over them. From TOPOMETRIC_CAN_CONTROLLERS,
/// "can0:can1": pairs of controllers with bit rate, states and queue, but emulated ones, which know no time
/// on the wire and lose what comes faster than their five frames of memory are read. None where it is not
/// set; tests/vm/can_test.py does.
[[nodiscard]] std::vector<CanPair> can_pairs();
[[nodiscard]] std::vector<CanPair> can_controllers();

/// With its base on CAN, and the scanners whose light costs an emulated processor least.
[[nodiscard]] sim::RobotConfig light_can_robot(const std::string& interface);

/// Hears and speaks on a CAN interface beside driver and robot.
class CanBus {
 public:
  struct Heard {
    std::uint32_t id = 0;
    std::vector<std::uint8_t> data;
    double realtime_s = 0.0;  ///< when the frame was on the wire, CLOCK_REALTIME
  };

  /// Hears the frames whose id is `id` under `mask`; 0, 0: all. Invalid when the interface is not there.
  explicit CanBus(const std::string& interface, std::uint32_t id = 0, std::uint32_t mask = 0);
  [[nodiscard]] bool valid() const { return socket_.valid(); }
  /// False when the interface's queue is full. `id` may carry the kernel's flags: error frames.
  bool send(std::uint32_t id, const std::vector<std::uint8_t>& data);
  std::optional<Heard> hear(double seconds);
  void forget();

 private:
  sim::FileDescriptor socket_;
};

[[nodiscard]] double realtime_s();

}  // namespace topo::test
