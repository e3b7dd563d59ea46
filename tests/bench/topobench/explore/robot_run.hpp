// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/bench/topobench/explore/explore_run.hpp"
#include "tests/bench/topobench/explore/team_node.hpp"

namespace topo::bench {

inline constexpr sim::SimTime kMeasurePeriod = std::chrono::seconds(1);

/// Is this moment the end of a whole number of periods?
inline bool is_due(sim::SimTime now, sim::SimTime period) { return now % period == sim::SimTime{0}; }

/// One robot's part of an exploration: its building, its mind, and what becomes of it. The result has
/// everything but what is said of the area.
class RobotRun {
 public:
  /// All are borrowed. `node`: of a robot in a team; else null. `begin`: when its mission is given to it.
  RobotRun(Plant& plant, RobotMind& mind, const RunSetup& setup, RunHooks& hooks, TeamNode* node = nullptr,
           sim::SimTime begin = sim::SimTime{0});

  /// One tick of everything: readings, mapping, and control and planning when they are due.
  void tick();
  /// What is noted every second.
  void note_pose();
  /// Notes the way when a share of the area is known: `known` has when.
  void note_way(const RunResult& known);
  /// The mission has ended and the robot has come to a stand.
  [[nodiscard]] bool is_over() const;
  /// At the end of the run. Home is where a robot entered: `starts`, of all robots.
  void finish(std::span<const sim::Se2> starts);

  [[nodiscard]] RunResult& result() { return result_; }
  [[nodiscard]] Plant& plant() { return plant_; }
  [[nodiscard]] const RobotMind& mind() const { return mind_; }

 private:
  void take_readings();
  void control(types::Stamp now);
  void plan(types::Stamp now);
  void note(const pipeline::PlanningReport& report, const pipeline::Plan& plan);
  void note(const plausibility::Opinion& opinion);
  void note_time(const pipeline::ControlReport& report);
  [[nodiscard]] sim::SimTime control_period() const;
  [[nodiscard]] sim::SimTime planning_period() const;

  Plant& plant_;
  RobotMind& mind_;
  const RunSetup& setup_;
  RunHooks& hooks_;
  TeamNode* node_;
  sim::SimTime begin_;
  Readings readings_, for_map_;
  RunResult result_;
  types::Stamp last_decision_{};
  plausibility::DoubtSet doubts_;
  TimeBook book_;
  std::uint64_t last_goal_ = 0;
};

/// Notes a share of the area: the coverage over time, and when the shares of RunResult were reached.
void note_coverage(const Coverage& coverage, double now_s, RunResult& result);

}  // namespace topo::bench
