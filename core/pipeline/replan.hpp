// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/pipeline/planning_memory.hpp"

// The second part of a planning step: map, analysis, decision, route.
namespace topo::pipeline {

/// What a decision changes.
struct Planned {
  exploration::Intent intent;
  Analysed analysed;
  HeldRoute route;
};

/// Keeps the route of the last decision while it holds; otherwise updates map, analysis, decision and route.
Planned planned(Planned before, const PlanningInput& in, const Whereabouts& place,
                const exploration::TeamView& team, bool battery_low, Caches& caches,
                const PlannerParams& params);

}  // namespace topo::pipeline
