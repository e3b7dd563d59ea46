// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "tests/sim/devices/sim_harness.hpp"
#include "tests/unit/sim/rooms.hpp"

namespace topo::sim {

/// One robot in the middle of the room of 8 x 6 m, looking along x. Null after a failure, which is added.
inline std::unique_ptr<SimHarness> start_in_room(RobotConfig robot, const Difficulty& difficulty) {
  RigConfig config;
  config.robots.push_back(std::move(robot));
  config.difficulty = difficulty;
  auto started = SimHarness::start(scene(room_text()), config);
  if (started) return std::move(*started);
  ADD_FAILURE() << started.error().message;
  return nullptr;
}

/// A device's address as the drivers and the configuration spell it.
inline std::string text_of(const DeviceAddress& address) {
  if (!address.interface.empty()) return "can:" + address.interface + ":" + std::to_string(address.unit);
  if (!address.tcp) return "serial:" + address.path.string();
  return "tcp:" + address.host + ":" + std::to_string(address.port);
}

}  // namespace topo::sim
