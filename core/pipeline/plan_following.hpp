// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "core/motion/path_follower.hpp"
#include "core/motion/recovery.hpp"
#include "core/motion/yielding.hpp"
#include "core/pipeline/control_params.hpp"
#include "core/pipeline/control_senses.hpp"
#include "core/pipeline/wish.hpp"

namespace topo::pipeline {

/// The end of a path that the robot has reached. A value.
struct Arrival {
  bool arrived = false;
  std::uint64_t goal = 0;
  types::Vector2 at_odom{0.0, 0.0};
};

/// Follows plans, waits for moving obstacles, and recovers when stuck. Allocates nothing. One thread.
class PlanFollowing {
 public:
  explicit PlanFollowing(const PlanFollowingParams& params = {}, const motion::MotionParams& motion = {});
  /// The wish for this period. `last`: result of the previous wish.
  Wish follow(const Plan& plan, const motion::GateInput& gate_in, const ControlSenses& senses,
              const Granted& last);
  /// Call in a period in which no plan moves the robot.
  void rest(types::Stamp now);
  /// Recoveries begun since the start.
  [[nodiscard]] std::uint32_t recoveries() const { return recovery_.begun(); }

 private:
  [[nodiscard]] motion::FollowOutput way(const Plan& plan, const types::Se2& T_odom_base,
                                         const motion::GateInput& gate_in, const types::Twist2& given);
  [[nodiscard]] motion::RecoveryOutput rescue(const Plan& plan, const motion::FollowOutput& out,
                                              const types::Se2& T_odom_base, const motion::GateInput& gate_in,
                                              const ControlSenses& senses, const Granted& last);

  PlanFollowingParams params_;
  double seen_behind_max_m_ = 0.0;  // EasingParams::seen_max_m
  motion::PathFollower follower_;
  motion::Recovery recovery_;
  motion::Yielding yielding_;
  std::array<types::Vector2, motion::PathFollower::kMaxObstacles> obstacles_{};
  bool recovering_ = false;  // the last period's motion was that of the recovery
  Arrival arrival_;
  motion::BreadcrumbPath
      no_breadcrumbs_;  // always empty: in place of the robot's when a team-mate is behind it
};

/// True when a bumper is pressed or a wheel stalls.
bool is_touching(const types::BaseState& base);

/// How far away the obstacles are that path following compares arcs by, and how far apart.
struct ObstacleReach {
  double reach_m = 0.0;
  double spacing_m = 0.0;
};
/// What is farther away cannot slow the robot: it stops before it from its greatest speed. The points are
/// farther apart as they reach farther: else those on the left, which come last, would not find room.
ObstacleReach obstacle_reach(const types::RobotLimits& limits, double blind_s,
                             const PlanFollowingParams& params);

}  // namespace topo::pipeline
