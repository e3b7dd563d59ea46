// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/analysis/analysis.hpp"
#include "core/exploration/decision_log.hpp"
#include "core/exploration/deferred_goals.hpp"
#include "core/exploration/final_sweep.hpp"
#include "core/exploration/goal_ways.hpp"
#include "core/exploration/mission.hpp"
#include "core/exploration/phase.hpp"
#include "core/exploration/pursuit.hpp"
#include "core/exploration/team_view.hpp"
#include "core/team/homes.hpp"
#include "core/team/last_contact.hpp"
#include "core/travel/obstacle_memory.hpp"
#include "core/travel/route_map.hpp"
#include "core/types/keyframe_pose.hpp"

namespace topo::exploration {

/// Input of a decision: facts of one period. Borrowed for the call.
struct Situation {
  types::Stamp now{};
  types::Se2 T_map_base;
  types::Vector2 start{0.0, 0.0};  ///< where the robot entered, in map
  Mission mission;
  bool battery_low = false;
  Feedback feedback;
  const analysis::Analysis& analysis;
  const goals::GoalParams& essential;     ///< parameters of the analysis
  std::span<const types::Vector2> route;  ///< the present one, in map
  TeamView team;
  std::span<const types::Polygon> here_first{};   ///< areas whose goals come before all others, in map
  std::span<const types::Vector2> doubted{};      ///< places to look at again before the end, in map
  std::span<const types::KeyframePose> driven{};  ///< the way by which the robot came

  [[nodiscard]] types::Vector2 here() const { return T_map_base.translation(); }
  [[nodiscard]] bool is_about(const Pursuit& pursuit) const { return feedback.number == pursuit.number; }
};

/// Searches of the map, as far as decisions need them.
struct Searches {
  travel::RouteMap& map;
  GoalWays& ways;  ///< between goals
};

/// Counts of an exploration that was about to end and continued.
struct Attempts {
  int resumed = 0;               ///< resumed on its way home
  int stuck = 0;                 ///< resumptions not counted because the robot was stuck
  int recalled = 0;              ///< times that goals given up were called back since one was reached
  types::Stamp nothing_since{};  ///< since when no goal is in reach; zero: there is one
  std::optional<types::Vector2>
      turned_at{};  ///< where the robot last turned on the spot to look behind itself
  std::optional<types::Vector2> looked_from{};  ///< where it last looked at what closes its way home
  int looks = 0;                                ///< times that it came to look there
};

struct SweepState {
  FinalSweep sweep;
  bool meanwhile = false;  ///< the sweep runs although goals without a route are left
  /// Doubted places at which the robot was for their doubt, or which it could not reach: each has one look.
  std::vector<types::Vector2> looked_again{};
};

/// What the robot offers to its team.
struct Offer {
  std::vector<team::Bid> bids;
  double claimed_m = 0.0;               ///< weighed cost of the goal when it was taken
  std::optional<team::Home> home;       ///< the start to which the robot returns
  types::Stamp ignore_passing_until{};  ///< standing aside did not help: for a while every robot keeps its
                                        ///< route
};

/// A goal that is left out because it gives too little for its time (worth.hpp).
struct LeftOutGoal {
  types::Vector2 p_map{0.0, 0.0};
  double gain_m2 = 0.0;
  double time_s = 0.0;
};

/// The alternatives at the last decision.
struct Outlook {
  std::vector<goals::Goal> open_goals;
  std::vector<LeftOutGoal> left_out;
  bool only_gaps = false;
  int clusters = 0;  ///< of frontiers, at least ExplorationParams::frontier_min_m wide
};

/// The robot's present purpose, and its memory of earlier attempts. A value: decide() takes one and returns
/// the next.
struct Intent {
  Phase phase;
  std::string reason = "no mission yet";
  Pursuit pursuit;
  Attempts attempts;
  DeferredGoals deferred;
  SweepState sweep;
  Offer offer;
  team::LastContact contact;
  travel::ObstacleMemory obstacles;
  DecisionLog log;
  Outlook outlook;
  /// An event has invalidated the costs of this period: the next period decides anew.
  bool is_outdated = false;
};

/// The intent of a new mission.
Intent begin_mission(Intent intent, Order order, types::Stamp now);

/// The robot was not allowed to go on for `elapsed`, by the operator or because its place is unknown: neither
/// its goal, nor the patience without one, nor the final sweep is charged with it.
Intent held_up(Intent intent, types::Duration elapsed);

/// The map was corrected: what is remembered by its place moves with it. The pursued goal is not: the next
/// decision is made anew.
Intent moved(Intent intent, const types::MapCorrection& correction);

/// One decision (paper sections I-A, II-E and II-F): the next target, and the reason.
Intent decide(const Situation& situation, Searches searches, const ExplorationParams& params, Intent intent);

// Parts of a decision; each takes an intent and returns the updated one.

/// Collects goals, assigns them within the team, and chooses one.
Intent explore(const Situation& situation, Searches searches, const ExplorationParams& params, Intent intent);
/// Leads home; the team decides what follows there (core/team/homes.hpp).
Intent go_home(const Situation& situation, Searches searches, const ExplorationParams& params, Intent intent);
/// Leads to the operator's target.
Intent go_to_target(const Situation& situation, Searches searches, const ExplorationParams& params,
                    Intent intent);
/// Begins, continues or ends standing aside for a team-mate.
Intent give_way(const Situation& situation, Searches searches, const ExplorationParams& params,
                Intent intent);
/// Begins, continues or ends the return to the place of last contact with a team-mate.
Intent keep_contact(const Situation& situation, Searches searches, const ExplorationParams& params,
                    Intent intent);

}  // namespace topo::exploration
