// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/analysis/analysis.hpp"
#include "core/exploration/decision_log.hpp"
#include "core/exploration/deferred_goals.hpp"
#include "core/exploration/mission.hpp"
#include "core/goals/goal.hpp"
#include "core/pipeline/control_step.hpp"
#include "core/pipeline/map_snapshot.hpp"
#include "core/pipeline/plan.hpp"
#include "core/pipeline/planning_params.hpp"
#include "core/team/status_message.hpp"
#include "core/types/result.hpp"

namespace topo::pipeline {

using exploration::Decision;
using exploration::Finish;
using exploration::Mission;
using exploration::Order;

/// Where the mapper has the robot now; newer than the snapshot.
struct TrackedPose {
  types::Stamp stamp{};        ///< of the last scan placed
  std::uint64_t revision = 0;  ///< of the map that the pose is in
  types::Transform2<types::Map, types::Odom> T_map_odom;
  bool matched = false;  ///< false: by the odometry from the last scan that did
};

/// What came from team-mates since the last period. A robot alone is a team of one, and hears nothing.
struct TeamInput {
  std::uint16_t robot = 0;                          ///< this one
  std::span<const team::StatusMessage> messages{};  ///< in any order, with any repetition
};

/// Stages of a decision.
enum class PlanningStage : std::uint8_t {
  kMap,       ///< the mapper's grid made ready
  kAnalysis,  ///< places and goals, when it is time to
  kTravel,    ///< clearance and what stands there now
  kDecision,  ///< what there is to go for, what that costs, and whose it is
  kRoute,
};
/// Called after each stage: a benchmark brings the clock.
using PlanningWatch = std::function<void(PlanningStage)>;

/// What one planning period looks at. Pointers: null when never heard of.
struct PlanningInput {
  types::Stamp now{};
  const MapSnapshot* map = nullptr;
  const TrackedPose* tracked = nullptr;
  const ControlReport* control = nullptr;
  const types::Scan* front = nullptr;  ///< newest, for obstacles that no keyframe holds yet
  TeamInput team;
  Mission mission;
  PlanningWatch done;  ///< may be empty
};

/// What planning knows, immutable once handed over; for status, files and pictures.
struct PlanningReport {
  std::uint64_t sequence = 0;
  types::Stamp stamp{};
  Activity activity = Activity::kIdle;
  std::string reason;  ///< one sentence: why this activity
  std::uint64_t mission = 0;
  bool mission_ended = false;  ///< done or failed
  bool second_phase = false;   ///< only gaps are left
  types::Transform2<types::Map, types::Base> T_map_base;
  types::Transform2<types::Map, types::Base> T_map_start;
  double known_m2 = 0.0;                               ///< free cells seen so far
  std::shared_ptr<const analysis::Analysis> analysis;  ///< newest; null before the first
  std::vector<goals::Goal> open_goals;                 ///< what may be chosen now, either phase
  std::vector<exploration::DeferredGoal> deferred;     ///< at this time
  std::vector<Decision> decisions;                     ///< the last 64, oldest first
  std::optional<goals::Goal> goal;                     ///< on the way to it
  std::vector<types::Vector2> route_map;
  int frontier_clusters = 0;  ///< at least 0.75 m wide, as explore_lite counts
  std::uint64_t goals_issued = 0;
  std::uint64_t decisions_made = 0;
  std::uint64_t clusters_sum = 0;  ///< over the decisions
  std::uint64_t goals_sum = 0;     ///< over the decisions
};

struct PlanningOutput {
  Plan plan;
  std::unique_ptr<const PlanningReport> report;  ///< never null
  team::StatusMessage message;                   ///< for team-mates
};

/// The planning thread's whole state. Used by one thread.
class PlanningState {
 public:
  explicit PlanningState(const PlannerParams& params);
  ~PlanningState();
  PlanningState(const PlanningState&) = delete;
  PlanningState& operator=(const PlanningState&) = delete;

 private:
  friend PlanningOutput planning_step(PlanningState&, const PlanningInput&);
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// One period (paper section II): where the robot is, the map for travelling, the analysis, a decision, a
/// route. Never throws; with anything missing or stale the plan is to stand, and the report says why.
PlanningOutput planning_step(PlanningState& state, const PlanningInput& input);

/// Can an operator's goal be gone to, as the map is? The reason when it cannot (unknown space, occupied, not
/// reachable, forbidden area). For the control socket, before a mission is made of it.
types::Status check_target(const analysis::Analysis& analysis, const PlannerParams& params,
                           const types::Vector2& from, const types::Vector2& target);

}  // namespace topo::pipeline
