// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "core/pipeline/mapping_step.hpp"
#include "tests/bench/carmen/relations.hpp"

namespace topo::bench {

/// Processor time of the calling thread and time by the clock, one value a call. The first is what a stage
/// costs, the second what a shared machine made of it.
struct StageTimes {
  std::vector<double> cpu_ms, wall_ms;
};

/// Takes the time from its making on.
class StageTimer {
 public:
  StageTimer();
  /// Adds what has gone by to the stages.
  void stop(std::initializer_list<StageTimes*> stages) const;

 private:
  double cpu_s_, wall_s_;
};

/// A scan's place relative to its keyframe, to be corrected at the end.
struct Hung {
  std::size_t node = 0;
  types::Se2 T_node_base;
};

/// What a mapping run produced, with the time that each stage cost.
struct MappingRun {
  std::vector<TimedPose> trajectory;  ///< every scan (its last beam), corrected by what came later
  std::vector<TimedPose> live;        ///< every scan, as it was told at once
  std::vector<Hung> hung;             ///< every scan, by the mapper's nodes
  StageTimes
      scan;  ///< a front scan's part of its step: odometry comes seldom, and a step places several scans
  StageTimes step;         ///< all that the mapping thread does at once; of these
  StageTimes track;        ///< steps that made no keyframe
  StageTimes keyframe;     ///< steps that made one: the map is drawn
  StageTimes correction;   ///< the same, and corrected poses were gone over to
  StageTimes loop_search;  ///< beside it, on the thread of loop closure
  StageTimes graph;        ///< the same thread: solutions of the pose graph
  StageTimes end;          ///< the last solution and drawing
  int closures_accepted = 0;
  int closures_rejected = 0;
  int lost = 0;        ///< scans placed by odometry alone
  int searched = 0;    ///< scans that needed the correlative search
  int degenerate = 0;  ///< scans that leave one direction to odometry
};

/// Runs the mapper's pure steps one after the other, as the daemon's threads run them side by side: an answer
/// to a query is handed over exactly `answer_delay` keyframes after its question, so that runs repeat.
class LockStep {
 public:
  explicit LockStep(pipeline::MappingState& state, std::size_t answer_delay = 2)
      : state_(state), answer_delay_(answer_delay) {}

  /// Called for every scan that was placed.
  std::function<void(const slam::MatchReport&)> on_match;
  /// Called for every search of a team-mate's map.
  std::function<void(const slam::Alignment&)> on_alignment;

  void step(const pipeline::MappingInput& input);

  /// The end of the input: what still waits is placed and applied, the graph solved once more, and the own
  /// past searched as by an idle robot. Call once.
  MappingRun finish();

 private:
  struct Waiting {
    std::size_t due = 0;
    slam::LoopAnswer answer;
  };
  void collect(const pipeline::MappingOutput& output);
  void hand_over();
  slam::Alignment align(const slam::AlignmentQuery& query);
  void look_back();

  pipeline::MappingState& state_;
  std::size_t answer_delay_;
  MappingRun run_;
  std::deque<Waiting> answers_;
  std::deque<std::pair<std::size_t, slam::Alignment>> alignments_;       ///< with when they are due
  std::optional<std::pair<std::size_t, slam::GraphSolution>> solution_;  ///< the same
  std::size_t keyframes_ = 0;
};

}  // namespace topo::bench
