// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/plan.hpp"

#include <algorithm>

#include "core/motion/path_follower.hpp"

namespace topo::pipeline {

std::string_view to_text(Activity activity) {
  switch (activity) {
    case Activity::kIdle:
      return "idle";
    case Activity::kExploring:
      return "exploring";
    case Activity::kThinking:
      return "thinking";
    case Activity::kGoingTo:
      return "going";
    case Activity::kReturning:
      return "returning";
    case Activity::kPaused:
      return "paused";
    case Activity::kDone:
      return "done";
    case Activity::kFailed:
      return "failed";
  }
  return "unknown";
}

void put_path(std::span<const types::Vector2> path_map,
              const types::Transform2<types::Map, types::Odom>& T_map_odom, Plan& plan) {
  const types::Se2 T_odom_map = T_map_odom.se2().inverse();
  static_assert(motion::PathFollower::kMaxPoints >= Plan::kMaxPoints, "a plan's end would not be followed");
  const std::size_t points = std::min(path_map.size(), Plan::kMaxPoints);
  for (std::size_t i = 0; i < points; ++i) plan.path_odom[i] = T_odom_map * path_map[i];
  plan.points = static_cast<std::uint16_t>(points);
  plan.path_ends_at_goal = points == path_map.size();
}

}  // namespace topo::pipeline
