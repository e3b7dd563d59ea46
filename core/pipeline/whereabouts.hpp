// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "core/pipeline/newest_keyframe.hpp"
#include "core/pipeline/planning_step.hpp"

namespace topo::pipeline {

/// The robot's pose in the map. A value.
struct Whereabouts {
  std::string missing;  ///< why planning is not possible now; empty: the pose is known and the robot may move
  bool located = false;    ///< the transforms belong to this period
  types::Stamp matched{};  ///< stamp of the last scan that matched the map; zero: none
  types::Transform2<types::Map, types::Odom> T_map_odom;
  types::Transform2<types::Map, types::Base> T_map_base;
  types::Transform2<types::Map, types::Base>
      T_map_start;          ///< pose of the first keyframe: the start moves with the map
  NewestKeyframe newest;    ///< of the previous period
  std::uint32_t bends = 0;  ///< Plan::bends

  [[nodiscard]] types::Se2 pose() const { return T_map_base.se2(); }
  [[nodiscard]] types::Vector2 here() const { return pose().translation(); }
};

/// Updates the pose from the newest map, scan and odometry.
Whereabouts locate(Whereabouts before, const PlanningInput& in, const WhereaboutsParams& params);

}  // namespace topo::pipeline
