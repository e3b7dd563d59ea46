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
#include "core/exploration/deferred_goals.hpp"
#include "core/exploration/final_sweep.hpp"
#include "core/exploration/strategy.hpp"
#include "core/goals/goal.hpp"
#include "core/grid/wavefront.hpp"
#include "core/pipeline/control_step.hpp"
#include "core/pipeline/map_snapshot.hpp"
#include "core/pipeline/plan.hpp"
#include "core/team/roster.hpp"
#include "core/types/area_limits.hpp"
#include "core/types/result.hpp"

namespace topo::pipeline {

enum class Finish : std::uint8_t {
  kEssential,  ///< home when no essential goal is left, and no gap onto a room (TourParams::overlooked_m2)
  kComplete,   ///< the remaining frontiers as well, in one tour with the essential goals, and last looks
};
std::string_view to_text(Finish finish);

/// The order in which a robot means to visit its goals (core/goals/tour.hpp).
struct TourParams {
  double length_share = 0.2;    ///< see exploration::tour_cost_m
  double leads_on_m2 = 10.0;    ///< what is hoped for behind an opening that is sure to lead on
  double shadow_m2 = 1.0;       ///< and behind any
  double gap_share = 0.5;       ///< what a gap is worth, against an essential goal that promises as much
  double pocket_m2 = 0.1;       ///< a gap onto less unknown space, enclosed, is nobody's goal
  double overlooked_m2 = 10.0;  ///< Finish::kEssential: onto more, a gap is looked at before going home
  double switch_share = 0.1;    ///< of the way to the present goal: what another tour has to save
  std::size_t goals_max = 20;   ///< the nearest; the others can wait
};

struct PlannerParams {
  exploration::Strategy strategy = exploration::Strategy::kTopometric;
  Finish finish = Finish::kComplete;
  bool k_means = true;  ///< false, an ablation: a team shares out single goals, not clusters of them
  analysis::AnalysisParams analysis;
  TourParams tour;
  exploration::FinalSweepParams final_sweep;  ///< Finish::kComplete
  grid::TravelRules travel;
  types::AreaLimits area;
  types::Se2 T_base_laser;       ///< front scanner, for what stands in the way now
  double frontier_min_m = 0.75;  ///< narrower frontiers are nobody's goal
  double goal_reached_m = 0.5;   ///< an exploration goal counts as visited from here
  double home_reached_m = 0.15;
  double give_up_s = 60.0;       ///< a goal given up comes back after this
  double visited_s = 300.0;      ///< one that a robot was at after this, when there are no last looks
  double switch_gain = 0.8;      ///< another goal must cost less than this share of the present one's
  double battery_home_v = 11.6;  ///< below for 10 s: home
  double charge_home = 0.2;      ///< the same for a reported state of charge
  bool coarse_analysis = false;  ///< of cells twice as wide: places and goals, not ways
  /// A decision holds this long while the map hardly changes, and not around the goal. Not under 1.5 s, which
  /// every decision holds; with more, gaps are passed by that would have been on the way.
  types::Duration quiet_decision_holds{0};
  team::RosterParams roster;
  /// Out of contact with all mates at work for longer: back to where one was last heard, then on. 0: never.
  double contact_lost_s = 240.0;
  double team_home_reached_m = 0.35;  ///< with others around: who is so near does not push them about
};

/// What the operator wants.
enum class Order : std::uint8_t { kStand, kExplore, kHome, kGoTo };

struct Mission {
  std::uint64_t number = 0;  ///< a new number is a new mission
  Order order = Order::kStand;
  bool paused = false;
  types::Vector2 target{0.0, 0.0};  ///< kGoTo, in map
};

/// Where the mapper has the robot now; newer than the snapshot.
struct TrackedPose {
  types::Stamp stamp{};        ///< of the last scan placed
  std::uint64_t revision = 0;  ///< of the map that the pose is in
  types::Transform2<types::Map, types::Odom> T_map_odom;
  bool matched = false;  ///< false: by the odometry from the last scan that did
};

/// What a robot of a team hears of the others.
struct TeamInput {
  std::uint16_t robot = 0;                        ///< this one
  std::span<const team::StatusMessage> messages;  ///< that came since the last period, in any order
};

/// What thinking a plan over consists of.
enum class PlanningStage : std::uint8_t {
  kMap,       ///< the mapper's grid made ready
  kAnalysis,  ///< places and goals, when it is time to
  kTravel,    ///< clearance and what stands there now
  kDecision,  ///< what there is to go for, what that costs, and whose it is
  kRoute,
};
/// Told after each stage: who measures brings the clock.
using PlanningWatch = std::function<void(PlanningStage)>;

/// What one planning period looks at. Pointers: null when never heard of.
struct PlanningInput {
  types::Stamp now{};
  const MapSnapshot* map = nullptr;
  const TrackedPose* tracked = nullptr;
  const ControlReport* control = nullptr;
  const types::Scan* front = nullptr;  ///< newest, for obstacles that no keyframe holds yet
  const TeamInput* team = nullptr;     ///< null: a robot alone
  Mission mission;
  PlanningWatch done;  ///< may be empty
};

/// A decision that an operator can read ("topoctl goals --why").
struct Decision {
  types::Stamp stamp{};
  types::Vector2 p_map{0.0, 0.0};
  std::string text;  ///< "taken: east side of place 3, opening 1.9 m, 12.3 m to go"
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
  std::optional<team::StatusMessage> message;    ///< for the others; of a robot in a team only
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

/// One period (DESIGN "Exploration"): analysis of the map when it changed, goals of the phase, choice, route.
/// Never throws; with anything missing or stale the plan is to stand, and the report says why.
PlanningOutput planning_step(PlanningState& state, const PlanningInput& input);

/// Can an operator's goal be gone to, as the map is? The reason when it cannot (unknown space, occupied, not
/// reachable, forbidden area). For the control socket, before a mission is made of it.
types::Status check_target(const analysis::Analysis& analysis, const PlannerParams& params,
                           const types::Vector2& from, const types::Vector2& target);

}  // namespace topo::pipeline
