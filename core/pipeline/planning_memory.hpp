// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/analysis/analysis.hpp"
#include "core/exploration/goal_ways.hpp"
#include "core/exploration/intent.hpp"
#include "core/pipeline/held_route.hpp"
#include "core/pipeline/planning_step.hpp"
#include "core/pipeline/whereabouts.hpp"
#include "core/team/roster.hpp"
#include "core/travel/route_map.hpp"
#include "core/types/map_correction.hpp"

// State that planning keeps from period to period: values, and searches.
namespace topo::pipeline {

/// A battery stays low for the mission: without load its voltage recovers a little, but not its charge.
struct Battery {
  bool low = false;
  types::Stamp low_since{};  ///< zero: the newest reading is not low
};

/// The newest analysis, and when it was made.
struct Analysed {
  std::shared_ptr<const analysis::Analysis> analysis;
  types::Stamp made{};
  types::Stamp idle_since{};  ///< since when there is no goal; zero: there is one
};

/// The team-mates heard so far.
struct Team {
  team::Roster roster;
  std::vector<types::Vector2> going_at;  ///< Roster::going_at() of this period
};

/// State that one period leaves to the next.
struct Memory {
  std::uint64_t sequence = 0;
  types::Stamp now{};  ///< of that period
  std::uint64_t mission = 0;
  Whereabouts place;
  types::MapAnchors anchors;  ///< of the places in `intent`
  Team team;
  exploration::Intent intent;
  Analysed analysed;
  HeldRoute route;
  Battery battery;
  std::uint32_t touches = 0;  ///< part of control's count that is already handled
};

/// Searches and working memory. Searches of the map equal new ones; the ways between goals are estimates
/// until each had its turn (goal_ways.hpp), so that a planner that begins with Memory alone may choose
/// another goal.
struct Caches {
  explicit Caches(const PlannerParams& params)
      : map(params.travel, params.area, params.route_map), ways(params.explore.tour.ways) {}

  travel::RouteMap map;
  exploration::GoalWays ways;
};

}  // namespace topo::pipeline
