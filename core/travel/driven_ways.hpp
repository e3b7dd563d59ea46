// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "core/types/keyframe_pose.hpp"
#include "core/types/se2.hpp"

namespace topo::travel {

/// Paths of robots: the robot's own keyframes, and one list for each of its team-mates.
struct DrivenWays {
  std::span<const types::KeyframePose> own;
  std::span<const std::vector<types::KeyframePose>> mates;
};

/// Calls visit(point in map) along the lines between consecutive keyframes of a way, at most `step_m` apart.
/// Where two keyframes are more than `gap_m` apart, the robot was carried or lost. `is_near`: lines that it
/// refuses by their end are left out.
template <class IsNear, class Visit>
void for_each_point(std::span<const types::KeyframePose> way, double gap_m, double step_m, IsNear is_near,
                    Visit visit) {
  for (std::size_t i = 1; i < way.size(); ++i) {
    const types::Vector2 a = way[i - 1].T_map_base.se2().translation();
    const types::Vector2 b = way[i].T_map_base.se2().translation();
    const double length_m = (b - a).norm();
    if (length_m > gap_m || !is_near(b)) continue;
    const int steps = static_cast<int>(std::ceil(length_m / step_m)) + 1;
    for (int k = 0; k <= steps; ++k) visit(types::Vector2(a + (b - a) * (static_cast<double>(k) / steps)));
  }
}

}  // namespace topo::travel
