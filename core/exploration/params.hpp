// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/exploration/strategy.hpp"
#include "core/exploration/sweep_params.hpp"
#include "core/types/stamp.hpp"

namespace topo::exploration {

enum class Finish : std::uint8_t {
  kEssential,  ///< home when no essential goal is left, and no gap onto a room (TourParams::overlooked_m2)
  kComplete,   ///< the remaining frontiers as well, in one tour with the essential goals, and the final sweep
};
std::string_view to_text(Finish finish);

/// The order in which a robot visits its goals (core/exploration/tour.hpp). Fitted on sixteen public floor
/// plans (doc/results.md).
struct TourParams {
  double length_share = 0.2;    ///< see tour_cost_m
  double leads_on_m2 = 10.0;    ///< expected behind an opening that is sure to lead on
  double shadow_m2 = 1.0;       ///< expected behind any opening
  double gap_share = 0.5;       ///< weight of a gap against an essential goal with as much behind it
  double pocket_m2 = 0.1;       ///< a gap onto less unknown space, enclosed, is no goal
  double overlooked_m2 = 10.0;  ///< Finish::kEssential: a gap onto more is inspected before going home
  double switch_share = 0.1;    ///< of the route to the present goal: what another tour has to save
  std::size_t goals_max = 20;   ///< the nearest; the others can wait
  double same_opening_m = 2.0;  ///< a frontier this near to an essential goal's opening is that opening
  double same_stand_m = 1.0;    ///< gaps inspected from this near to a goal need no goal of their own
  double exact_m = 6.0;         ///< costs of farther goals are those of the coarse map
  double far_reach_m = 0.6;     ///< between a goal's cell and the coarse cell that stands for it
};

/// When a goal counts as visited, and when it is given up.
struct PursuitParams {
  double goal_reached_m = 0.5;  ///< an exploration goal counts as visited from here
  double give_up_s = 60.0;      ///< a goal given up comes back after this
  double visited_s = 300.0;     ///< a visited one after this, when there is no final sweep
  double progress_m = 0.5;      ///< less than this is standing still
  /// Two recoveries of control: waiting, backing off and turning. Control takes up to a minute to report that
  /// it is stuck; another goal, or another route to this one, is the better use of that time.
  types::Duration standstill = std::chrono::seconds(25);
  types::Duration goal_time_max = std::chrono::seconds(240);
  double blocked_ahead_m = 0.45;  ///< from the robot's centre to what it got stuck on
};

/// When an exploration has ended.
struct EndingParams {
  types::Duration patience = std::chrono::seconds(6);  ///< a person may stand in a doorway for so long
  int resumes_max = 8;        ///< times that an exploration turns round on its way home
  int stuck_max = 16;         ///< times that getting stuck takes one of those back
  double resume_for_m = 1.2;  ///< a narrower opening does not turn a robot round
  /// Between two searches for viewpoints: when the robot waits for the answer, and while others explore.
  types::Duration sweep_again = std::chrono::seconds(1), sweep_again_meanwhile = std::chrono::seconds(30);
};

struct HomingParams {
  double home_reached_m = 0.15;
  double team_home_reached_m =
      0.35;                       ///< with team-mates around: robots this near do not push each other about
  double stuck_reached_m = 0.45;  ///< home is half a metre: a robot that gets no nearer is there
  double arrived_slack_m = 0.1;   ///< beside twice the above, where control reports the end of its path
  int standstills_max = 4;        ///< PursuitParams::standstill without progress: the mission has failed
};

/// Standing aside for a team-mate (core/team/right_of_way.hpp).
struct MakingWayParams {
  double search_m = 12.0;                              ///< to the next door or junction of a corridor
  double reached_m = 0.10;                             ///< nearer to the place the robot stands
  types::Duration at_most = std::chrono::seconds(30);  ///< then it does not help; and not again for as long
};

struct ExplorationParams {
  Strategy strategy = Strategy::kTopometric;
  Finish finish = Finish::kComplete;
  bool k_means = true;           ///< false, an ablation: a team shares out single goals, not clusters of them
  double frontier_min_m = 0.75;  ///< narrower frontiers are no goals
  double switch_gain = 0.8;      ///< another goal must cost less than this share of the present one's
  TourParams tour;
  FinalSweepParams final_sweep;  ///< Finish::kComplete
  PursuitParams pursuit;
  EndingParams ending;
  HomingParams homing;
  MakingWayParams making_way;
};

}  // namespace topo::exploration
