// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/exploration/intent.hpp"
#include "core/pipeline/newest_keyframe.hpp"
#include "core/pipeline/planning_step.hpp"
#include "core/pipeline/whereabouts.hpp"

namespace topo::pipeline {

/// The route of the last decision, and the basis of that decision. A value.
struct HeldRoute {
  std::vector<types::Vector2> points;        ///< to the target, in map
  types::Stamp decided{};                    ///< zero: the next period decides anew
  std::uint64_t changed_cells = 0;           ///< MapSnapshot::changed_cells at the decision
  NewestKeyframe newest;                     ///< of the map at the decision
  exploration::Claims claims;                ///< of team-mates at the decision
  std::vector<types::Polygon> here_first{};  ///< areas whose goals came first at the decision
};

/// True when the last decision is still valid: no relevant event, and no obstacle of `seen_now` in the way.
bool holds(const HeldRoute& route, const exploration::Intent& intent, const exploration::TeamView& team,
           const Whereabouts& place, const PlanningInput& in, const travel::RouteMap& map, bool battery_low,
           std::span<const types::Vector2> seen_now, const PlannerParams& params);

/// Without the part behind the robot.
HeldRoute trimmed(HeldRoute route, const types::Vector2& here, const travel::PathParams& path);

}  // namespace topo::pipeline
