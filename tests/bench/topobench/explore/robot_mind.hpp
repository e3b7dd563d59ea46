// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/pipeline/control_step.hpp"
#include "core/pipeline/planning_step.hpp"
#include "tests/bench/topobench/explore/map_source.hpp"

namespace topo::bench {

/// What stays the same during a run.
struct MindSetup {
  slam::MapperParams mapping;
  pipeline::PlannerParams planner;
  pipeline::ControlSetup control;
  std::vector<types::Se2> T_base_sonar;
  types::Duration firmware_watchdog = std::chrono::milliseconds(2000);
  pipeline::ControlParams control_params;
};

/// The daemon's threads in lock-step: the same pure steps, fed with readings, and nothing that knows the
/// truth. Not thread-safe.
class RobotMind {
 public:
  RobotMind(const MindSetup& setup, std::unique_ptr<MapSource> source);

  /// The scan, base and mapping threads' inputs. `for_map`: the same readings as mapping gets them.
  void take(const Readings& readings, const Readings& for_map);

  /// One period of the base thread.
  const pipeline::ControlOutput& control(types::Stamp now);

  /// One period of the planning thread. The base gets the plan with its next period.
  const pipeline::PlanningOutput& plan(types::Stamp now, const pipeline::Mission& mission,
                                       const pipeline::TeamInput& team = {},
                                       pipeline::PlanningWatch done = {});

  [[nodiscard]] const MapSource& source() const { return *source_; }
  /// Newest dead reckoning.
  [[nodiscard]] const types::Odometry& odometry() const { return state_.odometry; }

 private:
  MindSetup setup_;
  std::unique_ptr<MapSource> source_;
  pipeline::ControlState control_;
  pipeline::PlanningState planning_;
  pipeline::ControlOutput controlled_;
  pipeline::PlanningOutput planned_;
  types::BaseState state_;
  types::Scan front_;
  bool has_state_ = false, has_front_ = false, has_report_ = false, has_plan_ = false;
};

}  // namespace topo::bench
