// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "core/pipeline/newest_keyframe.hpp"
#include "core/pipeline/planning_step.hpp"

namespace topo::pipeline {

/// Where the robot is in the map. A value.
struct Whereabouts {
  std::string missing;  ///< why nothing can be planned now; empty: the robot's place is known and it may move
  bool located = false;    ///< the transforms are of this period
  types::Stamp matched{};  ///< the last scan that matched the map; zero: none
  types::Transform2<types::Map, types::Odom> T_map_odom;
  types::Transform2<types::Map, types::Base> T_map_base;
  types::Transform2<types::Map, types::Base>
      T_map_start;          ///< of the first keyframe: the start moves with the map
  NewestKeyframe newest;    ///< of the period before
  std::uint32_t bends = 0;  ///< Plan::bends

  [[nodiscard]] types::Se2 pose() const { return T_map_base.se2(); }
  [[nodiscard]] types::Vector2 here() const { return pose().translation(); }
};

/// Those of this period, by the newest map, scan and odometry.
Whereabouts locate(Whereabouts before, const PlanningInput& in, const WhereaboutsParams& params);

}  // namespace topo::pipeline
