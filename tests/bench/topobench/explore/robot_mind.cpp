// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/robot_mind.hpp"

namespace topo::bench {

RobotMind::RobotMind(const MindSetup& setup, std::unique_ptr<MapSource> source)
    : setup_(setup), source_(std::move(source)), control_(setup.control_params), planning_(setup.planner) {}

void RobotMind::take(const Readings& readings, const Readings& for_map) {
  source_->take(for_map);
  if (!readings.states.empty()) {
    state_ = readings.states.back();
    has_state_ = true;
  }
  if (!readings.front.empty()) {
    front_ = readings.front.back();
    has_front_ = true;
  }
}

const pipeline::ControlOutput& RobotMind::control(types::Stamp now) {
  pipeline::ControlInput input;
  input.now = now;
  input.plan = has_plan_ ? &planned_.plan : nullptr;
  input.state = has_state_ ? &state_ : nullptr;
  input.front = has_front_ ? &front_ : nullptr;
  input.matched = source_->matched();
  input.T_base_sonar = setup_.T_base_sonar;
  input.firmware_watchdog = setup_.firmware_watchdog;
  controlled_ = control_step(control_, setup_.control, input);
  has_report_ = true;
  return controlled_;
}

const pipeline::PlanningOutput& RobotMind::plan(types::Stamp now, const pipeline::Mission& mission,
                                                const pipeline::TeamInput& team,
                                                pipeline::PlanningWatch done) {
  pipeline::PlanningInput input;
  input.now = now;
  input.map = &source_->map();
  input.tracked = source_->tracked().stamp == types::Stamp{} ? nullptr : &source_->tracked();
  input.control = has_report_ ? &controlled_.report : nullptr;
  input.front = has_front_ ? &front_ : nullptr;
  input.team = team;
  input.mission = mission;
  input.done = std::move(done);
  planned_ = planning_step(planning_, input);
  has_plan_ = true;
  return planned_;
}

}  // namespace topo::bench
