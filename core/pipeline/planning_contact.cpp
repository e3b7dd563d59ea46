// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

// A robot that has heard of no mate for long goes back to where it last did, then on.

#include "core/pipeline/planning_state.hpp"

namespace topo::pipeline {

void PlanningState::Impl::end_seeking(const PlanningInput& in, const char* how) {
  note(in, T_map_base.se2().translation(), how);
  contact.put_off(in.now);
  seeks_contact = false;
  goal.reset();
  has_target = false;
  ++goal_id;
}

bool PlanningState::Impl::seek_contact(const PlanningInput& in) {
  const std::optional<types::Vector2> place = contact.lost_at(in.now);
  if (!place) {
    if (seeks_contact) end_seeking(in, "in contact again: on");
    return false;
  }
  if (!seeks_contact) {
    seeks_contact = true;
    note(in, *place, "out of contact for long: back to where another was last heard");
    goal.reset();  // what control says of its way is not about this one
  }
  const bool about_this = in.control->goal_id == goal_id && goal;
  const bool arrived = about_this && in.control->mode == ControlMode::kArrived;
  if (arrived || (*place - T_map_base.se2().translation()).norm() <= params.goal_reached_m) {
    end_seeking(in, "nobody is heard where one was: on");
    return false;
  }
  const bool stuck = about_this && in.control->mode == ControlMode::kStuck;
  if (stuck) block_ahead(in);
  if (!goal) {
    goals::Goal back;
    back.p_map = *place;
    set_out(in, back);
  }
  if (stuck || !is_getting_on(in)) {
    end_seeking(in, "no way to where another was last heard: on");
    return false;
  }
  const auto cell = reachable_cell(*place);
  if (!cell) {
    end_seeking(in, "no way to where another was last heard: on");
    return false;
  }
  has_target = true;
  target = *cell;
  activity = Activity::kExploring;
  reason = "goes back to where another was last heard";
  return true;
}

}  // namespace topo::pipeline
