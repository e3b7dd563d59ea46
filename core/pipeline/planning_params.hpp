// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

#include "core/analysis/analysis.hpp"
#include "core/exploration/params.hpp"
#include "core/grid/wavefront.hpp"
#include "core/team/roster.hpp"
#include "core/travel/params.hpp"
#include "core/types/area_limits.hpp"
#include "core/types/battery.hpp"
#include "core/types/se2.hpp"

namespace topo::pipeline {

/// When a route is kept for another period, and when a new decision is made.
struct RouteHoldParams {
  /// A decision holds this long unless an event occurs: 1 m at full speed, and the next keyframe or two.
  types::Duration decision_holds = std::chrono::milliseconds(1500);
  /// The same while the map hardly changes, in particular around the goal. Not less than decision_holds to
  /// have an effect; larger values make the robot pass gaps that are on its route.
  types::Duration quiet_decision_holds{0};
  /// Two thirds of an exploration's routes lead through known space, where little changes.
  double changed_m2 = 0.25;
  double around_goal_m = 1.5, changed_at_goal_m2 = 0.025;  ///< little change is needed to complete the map at
                                                           ///< a goal
  double off_route_m = 0.4;
  double correction_m = 0.10,
         correction_rad = 0.03;  ///< a larger correction of the map invalidates the route
};

/// When the robot's pose in the map is known.
struct WhereaboutsParams {
  types::Duration tracked_age_max = std::chrono::seconds(1);
  types::Duration control_age_max = std::chrono::milliseconds(500);
  /// Odometry alone is trusted for this time, 1.4 m at full speed. If a tenth of that is wheel slip, the
  /// robot is 0.14 m beside its estimated position, about the clearance on either side in a door of 0.8 m. A
  /// person who fills the view leaves sooner.
  types::Duration reckoned_max = std::chrono::seconds(2);
  double bent_m = 0.005, bent_rad = 0.005;  ///< corrections of the map; slip moves no keyframe
};

struct PlannerParams {
  exploration::ExplorationParams explore;
  analysis::AnalysisParams analysis;
  grid::TravelRules travel;
  travel::RouteMapParams route_map;
  travel::ObstacleMemoryParams obstacles;
  types::AreaLimits area;                                         ///< of the configuration
  types::Se2 T_base_laser;                                        ///< front scanner, for present obstacles
  types::Duration live_age_max = std::chrono::milliseconds(300);  ///< of the newest scan
  /// A scan is placed where the robot is now: while it turns faster, nothing is seen through. Within 300 ms
  /// it turns by 9 cm at 3 m, RouteMapParams::live_noise_m and a cell.
  double see_through_radps = 0.1;
  WhereaboutsParams whereabouts;
  RouteHoldParams hold;
  types::BatteryLimits battery{11.6, 0.2};  ///< return home when below for types::kBatteryLowFor
  bool coarse_analysis = false;             ///< with cells twice as wide: for places and goals, not routes
  team::RosterParams roster;
  /// Longest time without contact to all team-mates at work; then the robot returns to the place of last
  /// contact and continues. 0: never.
  double contact_lost_s = 240.0;
  double v_beside_mate_mps = 0.25;  ///< two approaching robots keep apart for the age of a scan
};

}  // namespace topo::pipeline
