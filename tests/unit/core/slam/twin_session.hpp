// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/slam/mapper.hpp"
#include "tests/unit/core/slam/matching_fixture.hpp"

namespace topo::slam::testing {

/// A map of mocks::twin_rooms() and what is needed to stand in one of them.
struct TwinSession {
  mocks::FlatWorld world = mocks::twin_rooms();
  std::mt19937 random{3};
  std::vector<types::Se2> way;  ///< in the world
  Session session;

  TwinSession() {
    look_round({3.5, 7.0, -1.57});
    for (int i = 0; i <= 40; ++i) way.push_back({3.5, 7.0 - 0.14 * i, -1.57});
    for (int i = 0; i <= 60; ++i) way.push_back({3.5 + 8.0 * i / 60, 1.4, 0.0});
    for (int i = 0; i <= 40; ++i) way.push_back({11.5, 1.4 + 0.14 * i, 1.57});
    look_round(way.back());
    Mapper mapper({});
    walls::ColumnCollector columns({});
    for (const types::Se2& pose : way)
      (void)mapper.add(view(pose).cloud, way.front().inverse() * pose, columns);
    session = mapper.session();
  }

  View view(const types::Se2& in_world) { return view_of(world, in_world, 0.01, random); }
  [[nodiscard]] types::Se2 in_map(const types::Se2& in_world) const {
    return way.front().inverse() * in_world;
  }

 private:
  void look_round(types::Se2 pose) {
    for (int i = 0; i < 25; ++i, pose.theta_rad = types::wrap_angle(pose.theta_rad + 0.25))
      way.push_back(pose);
  }
};

}  // namespace topo::slam::testing
