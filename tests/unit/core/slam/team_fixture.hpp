// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/slam/mapper.hpp"
#include "tests/unit/core/slam/matching_fixture.hpp"

namespace topo::slam::testing {

/// Poses every 0.12 m along straight legs, with turns on the spot at the corners.
inline std::vector<types::Se2> legs(const std::vector<types::Vector2>& corners) {
  std::vector<types::Se2> way;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const types::Vector2 leg = corners[i] - corners[i - 1];
    const double heading = std::atan2(leg.y(), leg.x());
    const double before = way.empty() ? heading : way.back().theta_rad;
    const double turn = types::wrap_angle(heading - before);
    for (int k = 1; k <= 8 && turn != 0.0; ++k)
      way.push_back({corners[i - 1].x(), corners[i - 1].y(), types::wrap_angle(before + turn * k / 8.0)});
    const int steps = static_cast<int>(leg.norm() / 0.12);
    for (int k = 0; k <= steps; ++k) {
      const types::Vector2 p = corners[i - 1] + leg * k / steps;
      way.push_back({p.x(), p.y(), heading});
    }
  }
  return way;
}

/// Drives a mapper along true poses with true odometry; its own closures are found at once.
inline void drive(Mapper& mapper, const mocks::FlatWorld& world, const std::vector<types::Se2>& way,
                  std::mt19937& random) {
  walls::ColumnCollector columns({});
  for (const types::Se2& pose : way) {
    (void)mapper.add(view_of(world, pose, 0.01, random).cloud, way.front().inverse() * pose, columns);
    if (const auto query = mapper.take_query()) (void)mapper.apply(find_closures(*query));
    correct(mapper);
  }
}

}  // namespace topo::slam::testing
