// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/pursuit.hpp"

#include <utility>

namespace topo::exploration {

Pursuit set_out(Pursuit pursuit, const goals::Goal& goal, GoalId id, types::Stamp now,
                const types::Vector2& here) {
  pursuit.goal = goal;
  pursuit.id = id;
  ++pursuit.number;
  pursuit.taken = pursuit.last_progress = now;
  pursuit.progress_at = here;
  pursuit.turn_to_rad.reset();
  return pursuit;
}

Pursuit turning_to(double heading_rad, Pursuit pursuit, types::Stamp now) {
  pursuit.goal.reset();
  pursuit.turn_to_rad = heading_rad;
  pursuit.has_target = false;
  pursuit.taken = pursuit.last_progress = now;
  ++pursuit.number;  // control's last report does not refer to the turn
  return pursuit;
}

Pursuit with_progress(Pursuit pursuit, const types::Vector2& here, types::Stamp now,
                      const PursuitParams& params) {
  if ((here - pursuit.progress_at).norm() > params.progress_m) {
    pursuit.progress_at = here;
    pursuit.last_progress = now;
  }
  return pursuit;
}

Pursuit without_goal(Pursuit pursuit) {
  pursuit.goal.reset();
  pursuit.turn_to_rad.reset();
  return pursuit;
}

Settled settled(const Pursuit& pursuit, const Feedback& feedback, const types::Vector2& here,
                const types::Vector2& target_map, double reached_m, types::Stamp now,
                const PursuitParams& params) {
  const bool about_this = feedback.number == pursuit.number;
  if (about_this && feedback.stuck) return Settled::kStuck;
  if (about_this && feedback.arrived) return Settled::kReached;
  if (!pursuit.turn_to_rad && (target_map - here).norm() <= reached_m) return Settled::kReached;
  if (now - pursuit.last_progress > params.standstill) return Settled::kNoProgress;
  if (now - pursuit.taken > params.goal_time_max) return Settled::kTooLong;
  return Settled::kUnderWay;
}

}  // namespace topo::exploration
