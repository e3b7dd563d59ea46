// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "core/types/stamp.hpp"
#include "core/types/transform.hpp"

namespace topo::pipeline {

/// The robot's present activity.
enum class Activity : std::uint8_t {
  kIdle,       ///< stands until a motion is ordered
  kExploring,  ///< on the way to an exploration goal
  kThinking,   ///< an exploration that has no goal at present
  kGoingTo,    ///< on the way to an operator's goal
  kReturning,  ///< on the way home
  kPaused,     ///< stands, the mission is kept
  kDone,       ///< the mission is complete
  kFailed,     ///< the mission was given up, for a reported reason
};
/// Name for tables and JSON: "idle", "exploring", ...
std::string_view to_text(Activity activity);

/// Planning's output for the base: the next metres of the route, in odom, so that a correction of the map
/// does not jerk the robot. Fixed size, for sync::Latest.
struct Plan {  // NOLINT(cppcoreguidelines-pro-type-member-init): the path is filled up to `points`
  static constexpr std::size_t kMaxPoints = 256;

  types::Stamp stamp{};        ///< older than a second: the robot stands
  std::uint64_t sequence = 0;  ///< counts the plans
  std::uint64_t goal_id = 0;   ///< counts the goals; control's report refers to this one
  Activity activity = Activity::kIdle;
  bool moving = false;                  ///< follow the path, or turn; false: stand
  std::optional<double> turn_to_rad{};  ///< in place of a path: the heading in odom to turn to on the spot
  bool path_ends_at_goal = false;       ///< the route is complete; false: it continues
                                        ///< beyond the path
  types::Transform2<types::Map, types::Odom> T_map_odom;  ///< with which the plan was made
  /// How often a correction of the map moved the robot: then T_map_odom jumped without a drift of odometry.
  std::uint32_t bends = 0;
  /// True when planning knew the robot's pose for this plan. False: T_map_odom is old or missing, and must
  /// not be used to compute a pose in map.
  bool located = false;
  double v_max_mps = HUGE_VAL;  ///< speed limit for now, in addition to that of the base
  bool mate_behind = false;     ///< a team-mate is behind on the breadcrumb path: no backing off
  std::uint16_t points = 0;
  std::array<types::Vector2, kMaxPoints> path_odom;  ///< as made by path.hpp, from the robot on
};

/// Copies the beginning of a path into the plan, in odom.
void put_path(std::span<const types::Vector2> path_map,
              const types::Transform2<types::Map, types::Odom>& T_map_odom, Plan& plan);

}  // namespace topo::pipeline
