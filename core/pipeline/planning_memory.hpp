// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/analysis/incremental_analysis.hpp"
#include "core/exploration/goal_ways.hpp"
#include "core/exploration/intent.hpp"
#include "core/pipeline/held_route.hpp"
#include "core/pipeline/planning_step.hpp"
#include "core/pipeline/whereabouts.hpp"
#include "core/team/roster.hpp"
#include "core/travel/route_map.hpp"

// What planning keeps from period to period: values, and caches that change no value.
namespace topo::pipeline {

/// A battery stays low for the mission: one that is spared recovers a little, and is as empty as before.
struct Battery {
  bool low = false;
  types::Stamp low_since{};  ///< zero: the newest reading is not low
};

/// The newest analysis, and when it was made.
struct Analysed {
  std::shared_ptr<const analysis::Analysis> analysis;
  types::Stamp made{};
  types::Stamp idle_since{};  ///< without a goal; zero: with one
};

/// The team-mates, as far as they were heard.
struct Team {
  team::Roster roster;
  std::vector<types::Vector2> going_at;  ///< Roster::going_at() of this period
};

/// What a period leaves to the next.
struct Memory {
  std::uint64_t sequence = 0;
  std::uint64_t mission = 0;
  Whereabouts place;
  Team team;
  exploration::Intent intent;
  Analysed analysed;
  HeldRoute route;
  Battery battery;
  std::uint32_t touches = 0;  ///< of control's count, those remembered
};

/// Searches and scratch: they give what they would give anew.
struct Caches {
  explicit Caches(const PlannerParams& params) : map(params.travel, params.area, params.route_map) {}

  travel::RouteMap map;
  exploration::GoalWays ways;
  analysis::IncrementalAnalysis analysis;
};

}  // namespace topo::pipeline
