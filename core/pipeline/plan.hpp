// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "core/types/stamp.hpp"
#include "core/types/transform.hpp"

namespace topo::pipeline {

/// What the robot is about.
enum class Activity : std::uint8_t {
  kIdle,       ///< stands until it is told to move
  kExploring,  ///< on the way to an exploration goal
  kThinking,   ///< an exploration without a goal for the moment
  kGoingTo,    ///< on the way to an operator's goal
  kReturning,  ///< on the way home
  kPaused,     ///< stands, the mission is kept
  kDone,       ///< the mission is fulfilled
  kFailed,     ///< the mission was given up, for a reason that can be read
};
/// One message for tables and JSON: "idle", "exploring", ...
std::string_view to_text(Activity activity);

/// What planning hands to the base: the next metres of the way, in odom, so that a correction of the map does
/// not jerk the robot. Fixed size: it goes through a sync::Latest.
struct Plan {  // NOLINT(cppcoreguidelines-pro-type-member-init): the path is filled up to `points`
  static constexpr std::size_t kMaxPoints = 256;

  types::Stamp stamp{};        ///< older than a second: the robot stands
  std::uint64_t sequence = 0;  ///< counts the plans
  std::uint64_t goal_id = 0;   ///< counts the goals; control reports on this one
  Activity activity = Activity::kIdle;
  bool moving = false;                                    ///< follow the path; false: stand
  bool path_ends_at_goal = false;                         ///< the whole way is here; else it goes on
  types::Transform2<types::Map, types::Odom> T_map_odom;  ///< the plan was made with
  /// How often the map was bent where the robot is: then T_map_odom jumped though no odometry drifted.
  std::uint32_t bends = 0;
  /// Planning knew the robot's place when it made the plan. False: T_map_odom is an old one or none at all,
  /// and nobody may take the place of the robot in map from it.
  bool located = false;
  double v_max_mps = HUGE_VAL;  ///< no faster for now, whatever the base could
  bool mate_behind = false;     ///< on the way that it came stands a mate: no backing off
  std::uint16_t points = 0;
  std::array<types::Vector2, kMaxPoints> path_odom;  ///< as path.hpp makes it, from the robot on
};

/// The path's beginning into the plan, in odom.
void put_path(std::span<const types::Vector2> path_map,
              const types::Transform2<types::Map, types::Odom>& T_map_odom, Plan& plan);

}  // namespace topo::pipeline
