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

namespace topo::exploration {

/// What a decision is made by: facts of one period. Borrowed for the call.
struct Situation {
  types::Stamp now{};
  types::Se2 T_map_base;
  types::Vector2 start{0.0, 0.0};  ///< where the robot entered, in map
  Mission mission;
  bool battery_low = false;
  Feedback feedback;
  const analysis::Analysis& analysis;
  const goals::GoalParams& essential;                  ///< that the analysis was made with
  std::span<const std::vector<types::Vector2>> paths;  ///< driven by all robots, in map
  std::span<const types::Vector2> route;               ///< the present one, in map
  TeamView team;

  [[nodiscard]] types::Vector2 here() const { return T_map_base.translation(); }
  [[nodiscard]] bool is_about(const Pursuit& pursuit) const { return feedback.number == pursuit.number; }
};

/// Searches of the map, as far as decisions need them; they remember, and give what they would give anew.
struct Searches {
  travel::RouteMap& map;
  GoalWays& ways;  ///< between goals
};

/// How often an exploration that was about to end went on.
struct Attempts {
  int resumed = 0;               ///< on its way home
  int stuck = 0;                 ///< times that getting stuck took one of those back
  types::Stamp nothing_since{};  ///< when the last goal in reach was gone; zero: there is one
};

struct SweepState {
  FinalSweep sweep;
  bool meanwhile = false;  ///< it goes on although there are goals, to which no route leads
};

/// What the robot offers its team.
struct Offer {
  std::vector<team::Bid> bids;
  double claimed_m = 0.0;               ///< what the route to the goal counted when the goal was taken
  std::optional<team::Home> home;       ///< the start that the robot comes home to
  types::Stamp ignore_passing_until{};  ///< standing aside did not help: for a while each goes its way
};

/// What there was to choose among at the last decision.
struct Outlook {
  std::vector<goals::Goal> open_goals;
  bool only_gaps = false;
  int clusters = 0;  ///< of frontiers, at least ExplorationParams::frontier_min_m wide
};

/// What the robot is about, and what it remembers of what it tried. A value: decide() takes one and gives the
/// next.
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
  /// Something happened that this period's costs do not know of: the next period decides anew.
  bool is_outdated = false;
};

/// The intent of a new mission.
Intent begin_mission(Intent intent, Order order, types::Stamp now);

/// One decision (paper sections I-A, II-E and II-F): where to go, and why.
Intent decide(const Situation& situation, Searches searches, const ExplorationParams& params, Intent intent);

// Parts of a decision; each takes the intent at its beginning and gives that at its end.

/// Goals proposed, shared out and chosen.
Intent explore(const Situation& situation, Searches searches, const ExplorationParams& params, Intent intent);
/// Towards home; what follows there is decided by the team (core/team/homes.hpp).
Intent go_home(const Situation& situation, Searches searches, const ExplorationParams& params, Intent intent);
/// Towards the operator's target.
Intent go_to_target(const Situation& situation, Searches searches, const ExplorationParams& params,
                    Intent intent);
/// Begins, goes on with or ends standing aside for a team-mate.
Intent give_way(const Situation& situation, Searches searches, const ExplorationParams& params,
                Intent intent);
/// Begins, goes on with or ends the search for a team-mate that was not heard of for long.
Intent keep_contact(const Situation& situation, Searches searches, const ExplorationParams& params,
                    Intent intent);

}  // namespace topo::exploration
