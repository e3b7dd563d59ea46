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

/// When a route is taken for another period, and when it is decided anew.
struct RouteHoldParams {
  /// A decision holds this long unless something happens: 1 m at full speed, and the next keyframe or two.
  types::Duration decision_holds = std::chrono::milliseconds(1500);
  /// The same while the map hardly changes, and not around the goal. Not under decision_holds; with more,
  /// gaps are passed by that would have been on the way.
  types::Duration quiet_decision_holds{0};
  /// Two thirds of an exploration's way lead through what is known, and then little changes.
  double changed_m2 = 0.25;
  double around_goal_m = 1.5, changed_at_goal_m2 = 0.025;  ///< what closes a goal is little, too
  double off_route_m = 0.4;
  double correction_m = 0.10,
         correction_rad = 0.03;  ///< after such a correction of the map a route is another one
};

/// When the robot's place in the map is known.
struct WhereaboutsParams {
  types::Duration tracked_age_max = std::chrono::seconds(1);
  types::Duration control_age_max = std::chrono::milliseconds(500);
  /// Odometry alone is believed for so long. At full speed it is 1.4 m of way: a tenth of that in slipping
  /// wheels puts the robot 0.14 m beside where it seems to be, which is about the room that a door of 0.8 m
  /// leaves on either side. A person who fills the view is gone sooner.
  types::Duration reckoned_max = std::chrono::seconds(2);
  double bent_m = 0.005, bent_rad = 0.005;  ///< a correction of the map; slip moves no keyframe at all
};

struct PlannerParams {
  exploration::ExplorationParams explore;
  analysis::AnalysisParams analysis;
  grid::TravelRules travel;
  travel::RouteMapParams route_map;
  travel::ObstacleMemoryParams obstacles;
  types::AreaLimits area;
  types::Se2 T_base_laser;  ///< front scanner, for what stands in the way now
  types::Duration live_age_max = std::chrono::milliseconds(300);  ///< of the newest scan
  WhereaboutsParams whereabouts;
  RouteHoldParams hold;
  types::BatteryLimits battery{11.6, 0.2};  ///< below for types::kBatteryLowFor: home
  bool coarse_analysis = false;             ///< of cells twice as wide: places and goals, not routes
  team::RosterParams roster;
  /// Out of contact with all team-mates at work for longer: back to where one was last heard, then on. 0:
  /// never.
  double contact_lost_s = 240.0;
  double v_beside_mate_mps = 0.25;  ///< two robots, closing for a scan's age, are still apart
};

}  // namespace topo::pipeline
