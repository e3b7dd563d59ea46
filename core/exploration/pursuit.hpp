// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "core/exploration/goal_choice.hpp"
#include "core/exploration/params.hpp"
#include "core/goals/goal.hpp"
#include "core/grid/dense_map.hpp"
#include "core/types/se2.hpp"
#include "core/types/stamp.hpp"

namespace topo::exploration {

/// The present goal, and the progress towards it. A value.
struct Pursuit {
  /// Counts goals and new attempts at them; control's report contains the number to which it refers.
  std::uint64_t number = 0;
  std::optional<goals::Goal> goal;
  GoalId id;  ///< of the goal
  grid::CellIndex target;
  bool has_target = false;  ///< a route to `target` is required
  /// Heading in map to which the robot turns on the spot, to see what lies behind it (look_behind.hpp).
  std::optional<double> turn_to_rad;
  types::Stamp taken{}, last_progress{};
  types::Vector2 progress_at{0.0, 0.0};
};

/// The part of control's report on a pursuit that planning needs.
struct Feedback {
  std::uint64_t number = 0;  ///< of the pursuit to which it refers
  bool arrived = false;      ///< at the end of a path that ends at the goal
  bool stuck = false;        ///< recovery did not help
  double v_mps = 0.0;        ///< measured
};

/// Begins the pursuit of another goal.
Pursuit set_out(Pursuit pursuit, const goals::Goal& goal, GoalId id, types::Stamp now,
                const types::Vector2& here);
/// Updates the progress to the robot's position `here`.
Pursuit with_progress(Pursuit pursuit, const types::Vector2& here, types::Stamp now,
                      const PursuitParams& params);
/// Drops the goal for a turn on the spot.
Pursuit turning_to(double heading_rad, Pursuit pursuit, types::Stamp now);
/// Drops the goal, and the turn. The target stays.
Pursuit without_goal(Pursuit pursuit);

enum class Settled : std::uint8_t { kUnderWay, kReached, kStuck, kNoProgress, kTooLong };
/// State of a pursuit with a goal, or of a turn: control alone reports its end. `target_map`: centre of its
/// target. `reached_m`: distance that counts as visited.
Settled settled(const Pursuit& pursuit, const Feedback& feedback, const types::Vector2& here,
                const types::Vector2& target_map, double reached_m, types::Stamp now,
                const PursuitParams& params);

}  // namespace topo::exploration
