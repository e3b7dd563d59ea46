// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>

#include "core/exploration/finish.hpp"
#include "core/exploration/strategy.hpp"
#include "core/exploration/sweep_params.hpp"
#include "core/exploration/worth.hpp"
#include "core/team/right_of_way_params.hpp"
#include "core/types/robot_limits.hpp"
#include "core/types/stamp.hpp"

// Parameters of exploration, which was developed on the sixteen public floor plans of doc/results.md: a value
// comes from there unless its comment names another source.
namespace topo::exploration {

/// From a goal to the cell from which the robot attends to it, and the cost of that (goal_choice.hpp).
struct CandidateParams {
  double cell_reach_m = 0.6;   ///< to a reachable cell, when the goal's own is closed by an obstacle
  double unseen_way_m = 3.0;   ///< from a goal to the end of the known route, at most
  double unknown_way_m = 3.0;  ///< the same through unknown cells, when no other goal is left: the shadows of
                               ///< a row of pillars
  double unknown_reach_m = 12.0;  ///< from such a goal to the end of the known route, at most
  double frontier_reach_m = 1.0;  ///< a frontier is visible from this distance
  double successor_m = 2.5;       ///< largest displacement of a goal from one map to the next
  double turn_m_per_rad = 1.0;    ///< cost to stop, turn on the spot and accelerate again
  double beginning_m = 1.0;       ///< stretch of a route that defines its initial direction
  double pocket_reach_m = 1.2;    ///< unknown space behind a frontier that ends within this is a pocket
};

/// Costs between goals, from one decision to the next (goal_ways.hpp).
struct GoalWaysParams {
  double reach_m = 0.6;      ///< to the nearest reachable cell: goals are near walls
  double beside_m = 1.0;     ///< within this distance the costs of one cell approximate those of another
  std::size_t searches = 3;  ///< of the map at each update: bounds its time
};

/// Goals that were given up or visited (deferred_goals.hpp).
struct DeferralParams {
  double same_m = 0.8;  ///< goals within this distance are one goal
  int times_max = 2;    ///< a goal deferred this often does not come back
};

/// Team-mates as seen by one robot (team_view.hpp).
struct TeamViewParams {
  double way_m = 6.0;          ///< length of the route in a status message
  double way_spacing_m = 0.3;  ///< of its points: less than the width of a robot
  double behind_m = 1.5;       ///< half a metre of backing off, and the length of two robots
  team::RightOfWayParams right_of_way;
};

/// The order in which a robot visits its goals (core/exploration/tour.hpp).
struct TourParams {
  double length_share = 0.2;   ///< see tour_cost_m
  double leads_on_m2 = 10.0;   ///< expected area behind an opening that certainly leads on
  double shadow_m2 = 1.0;      ///< expected area behind any opening
  double gap_share = 0.5;      ///< weight of a gap relative to an essential goal with the same area behind
                               ///< it
  double pocket_m2 = 0.1;      ///< a gap onto less enclosed unknown space is no goal
  double overlooked_m2 = 5.0;  ///< Finish::kEssential: a gap onto more is inspected before the return
  double overlooked_look_m = 6.0;  ///< depth to which that is counted: of a room 1.7 m wide
  double switch_share = 0.1;    ///< least saving of another tour, as a share of the route to the present goal
  std::size_t goals_max = 40;   ///< only the nearest goals are considered: more than there are mostly, as
                                ///< those beyond are not judged (Finish::kWorth)
  double now_share = 0.25;      ///< a gap is filled on the way to the first goal of a tour when the detour is
                                ///< at most this share of coming back for it from there
  double same_opening_m = 2.0;  ///< a frontier within this distance of an essential goal's opening is that
                                ///< opening
  double same_stand_m = 1.0;    ///< gaps inspected from within this distance of a goal need no goal of their
                                ///< own
  double exact_m = 6.0;         ///< costs of goals beyond this are those of the coarse map
  double far_reach_m = 0.6;     ///< between a goal's cell and the coarse cell that represents it
  GoalWaysParams ways;
};

/// When a goal counts as visited, and when it is given up.
struct PursuitParams {
  double goal_reached_m = 0.5;  ///< distance at which an exploration goal counts as visited
  double give_up_s = 60.0;      ///< a goal that was given up comes back after this
  double visited_s = 300.0;     ///< a visited one after this, when there is no final sweep
  double progress_m = 0.5;      ///< less movement counts as standing still
  /// Two recoveries of control: waiting, backing off and turning. Control takes up to a minute to report that
  /// the robot is stuck; another goal, or another route to this one, uses that time better.
  types::Duration standstill = std::chrono::seconds(25);
  types::Duration goal_time_max = std::chrono::seconds(240);
  double blocked_ahead_m = 0.45;  ///< from the robot's centre to the obstacle at which it got stuck
  double mate_ahead_m = 0.9;      ///< the same to the centre of a team-mate
};

/// A turn on the spot towards what is unknown behind the robot (look_behind.hpp).
struct LookBehindParams {
  double seen_rad =
      2.2;  ///< a UTM-30LX sees 135 degrees to either side; nine of them at the ends do not count
  double ray_rad = 0.0873;  ///< between rays: five degrees
  int rays_min = 3;         ///< fewer end by chance in cells that no beam met
  double reach_m = 1.0;     ///< farther away, the sides see round what hides it
  double again_m = 0.5;     ///< no second turn within this distance of the last one
};

/// When an exploration has ended.
struct EndingParams {
  bool stays_out = false;  ///< with nothing left to gain the robot does not go home before its mates have no
                           ///< goals either (ablation)
  types::Duration patience = std::chrono::seconds(6);  ///< a person may stand in a doorway for this time
  int resumes_max = 8;                                 ///< limit of resumptions on the way home
  int recalls_max = 2;                                 ///< as often as this goals given up are tried again
                                                       ///< before one is reached
  int stuck_max = 16;               ///< limit of resumptions not counted because the robot was stuck
  double resume_for_m = 1.2;        ///< a narrower opening does not cause a resumption
  double looked_again_m = 3.0;      ///< doubted places so near have one look together; half of
                                    ///< LoopParams::search_max_m, by which a correction may move them
  double look_again_chance = 0.25;  ///< least chance that what may be gone hides more of the building:
                                    ///< a person in a corridor of 1.25 m hides 0.55
  /// Period of searches for viewpoints: while the robot waits for the result, and while team-mates explore.
  types::Duration sweep_again = std::chrono::seconds(1), sweep_again_meanwhile = std::chrono::seconds(30);
};

struct HomingParams {
  double home_reached_m = 0.15;
  double team_home_reached_m = 0.35;  ///< in a team: robots at this distance do not push each other about
  double stuck_reached_m = 0.45;      ///< home has a radius of about half a metre: a robot that is stuck, or
                                  ///< stands still, within it has arrived; in a team RosterParams::at_start_m
  double brakes_mps2 = types::DriveLimits{}.deceleration_mps2;  ///< from which follows how far it rolls on
  double arrived_slack_m = 0.1;  ///< added to twice the distance above, where control reports the end of its
                                 ///< path
  double look_from_m = 1.0;      ///< from what closes the way: a P3-DX is 0.53 m long, and turns there
  double looks_apart_m = 3.0;    ///< farther apart, looks are at other things: RouteMapParams::live_range_m
  int standstills_max = 4;       ///< multiple of PursuitParams::standstill without progress after which the
                                 ///< mission fails; so many looks at one thing are progress
};

/// Standing aside for a team-mate (core/team/right_of_way.hpp).
struct MakingWayParams {
  double search_m = 12.0;                              ///< up to the next door or junction of a corridor
  double reached_m = 0.10;                             ///< the robot does not move when it is this close to
                                                       ///< the chosen cell
  types::Duration at_most = std::chrono::seconds(30);  ///< limit of standing aside, and then pause before the
                                                       ///< next time
};

struct ExplorationParams {
  Strategy strategy = Strategy::kTopometric;
  Finish finish = Finish::kComplete;
  WorthParams worth;               ///< Finish::kWorth
  std::optional<team::Rule> rule;  ///< in place of the strategy's, an ablation
  double frontier_min_m = 0.75;    ///< narrower frontiers are no goals
  double switch_gain = 0.8;        ///< another goal must cost less than this share of the present one's
  CandidateParams candidate;
  TourParams tour;
  DeferralParams deferral;
  FinalSweepParams final_sweep;  ///< Finish::kComplete
  PursuitParams pursuit;
  LookBehindParams look_behind;
  EndingParams ending;
  HomingParams homing;
  MakingWayParams making_way;
  TeamViewParams team_view;
};

/// The parameters of a rule.
inline void set_finish(const FinishRule& rule, ExplorationParams& params) {
  params.finish = rule.finish;
  if (rule.finish == Finish::kWorth) params.worth.rate_m2ps = rule.rate_m2ps;
}

}  // namespace topo::exploration
