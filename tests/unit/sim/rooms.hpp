// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "tests/sim/world.hpp"

namespace topo::sim {

/// A scene that must parse.
inline World scene(const std::string& text) {
  auto world = World::from_scene_text(text, "test.toml");
  if (!world.has_value()) {
    ADD_FAILURE() << world.error().message;
    std::abort();
  }
  return std::move(*world);
}

/// Room of 8 x 6 m between the wall's inner faces, the origin in its lower left corner.
inline std::string room_text() {
  return R"(
[[start]]
x_m = 4.0
y_m = 3.0
[[wall]]
points_m = [[-0.1, -0.1], [8.1, -0.1], [8.1, 6.1], [-0.1, 6.1]]
closed = true
thickness_m = 0.2
)";
}

/// A hall of 30 x 8 m with nothing in it; the robot starts at (2, 4) to the east.
inline std::string hall_text() {
  return R"(
[[start]]
x_m = 2.0
y_m = 4.0
[[wall]]
points_m = [[-0.1, -0.1], [30.1, -0.1], [30.1, 8.1], [-0.1, 8.1]]
closed = true
thickness_m = 0.2
)";
}

}  // namespace topo::sim
