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

/// The mapper's present correction of the odometry; newer than the snapshot.
struct TrackedPose {
  types::Stamp stamp{};        ///< of the last scan placed
  std::uint64_t revision = 0;  ///< of the map to which the pose belongs
  types::Transform2<types::Map, types::Odom> T_map_odom;
  bool matched = false;  ///< false: carried on by odometry since the last match
};

/// Messages of team-mates since the last period. A single robot is a team of one, and receives none.
struct TeamInput {
  std::uint16_t robot = 0;                          ///< this one
  std::span<const team::StatusMessage> messages{};  ///< in any order, with any repetition
};

/// Stages of a decision.
enum class PlanningStage : std::uint8_t {
  kMap,       ///< preparation of the mapper's grid
  kAnalysis,  ///< places and goals, when due
  kTravel,    ///< clearance and present obstacles
  kDecision,  ///< candidates, their costs, and their assignment
  kRoute,
};
/// Called after each stage. A benchmark supplies the clock.
using PlanningWatch = std::function<void(PlanningStage)>;

/// Input of one planning period. Pointers: null before the first value.
struct PlanningInput {
  types::Stamp now{};
  const MapSnapshot* map = nullptr;
  const TrackedPose* tracked = nullptr;
  const ControlReport* control = nullptr;
  const types::Scan* front = nullptr;  ///< the newest, for obstacles that no keyframe contains yet
  TeamInput team;
  Mission mission;
  PlanningWatch done;                            ///< may be empty
  const types::AreaLimits* area = nullptr;       ///< all that are in force; null: the configuration's alone
  std::span<const types::Polygon> here_first{};  ///< areas whose goals come before all others
  std::span<const types::Vector2> doubted{};     ///< places to look at again before an exploration ends
};

/// State of planning for status, files and pictures; immutable once published.
struct PlanningReport {
  std::uint64_t sequence = 0;
  types::Stamp stamp{};
  Activity activity = Activity::kIdle;
  std::string reason;  ///< one sentence: the reason of the activity
  std::uint64_t mission = 0;
  bool mission_ended = false;  ///< done or failed
  bool second_phase = false;   ///< only gaps are left
  types::Transform2<types::Map, types::Base> T_map_base;
  types::Transform2<types::Map, types::Base> T_map_start;
  double known_m2 = 0.0;                               ///< area of the free cells seen so far
  std::shared_ptr<const analysis::Analysis> analysis;  ///< newest; null before the first
  types::AreaLimits area;                              ///< those that the analysis was made with
  std::vector<goals::Goal> open_goals;                 ///< available alternatives, in both phases
  std::vector<exploration::DeferredGoal> deferred;     ///< at this time
  std::vector<Decision> decisions;                     ///< the last 64, oldest first
  std::optional<goals::Goal> goal;                     ///< the present one
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

/// The complete state of the planning thread. Used by one thread.
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

/// One period (paper section II): localisation, the map for travel, the analysis, a decision, a route. Never
/// throws; when an input is missing or stale the plan is to stand, and the report contains the reason.
PlanningOutput planning_step(PlanningState& state, const PlanningInput& input);

/// What an operator's goal is checked against: of a report.
struct TargetGround {
  std::shared_ptr<const analysis::Analysis> analysis;  ///< never null
  types::AreaLimits area;
  types::Vector2 from{0.0, 0.0};  ///< where the robot is
};

/// Success when an operator's goal can be reached on the present map, else the reason (unknown space,
/// occupied, not reachable, forbidden area: `params.area` is what is in force). kBusy: the analysis was made
/// before the areas changed. For the control socket, before the goal becomes a mission.
types::Status check_target(const TargetGround& ground, const PlannerParams& params,
                           const types::Vector2& target);

}  // namespace topo::pipeline
