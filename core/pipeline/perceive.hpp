// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/pipeline/planning_memory.hpp"

// The first part of a planning step: orders, team-mates, battery, and detections of sonar, bumpers and
// scanner.
namespace topo::pipeline {

/// Applies the operator's orders to the intent. `mission`: number of the previous mission.
exploration::Intent ordered(exploration::Intent intent, std::uint64_t mission, const PlanningInput& in);

struct Heard {
  Team team;
  team::LastContact contact;
};

/// Takes the messages of this period. `here`: the robot's last known position.
Heard heard(Heard before, const PlanningInput& in, const types::Vector2& here);

Battery watched(Battery battery, const ControlReport& control, const types::BatteryLimits& limits,
                types::Stamp now);

/// Adds the echoes of this period, and a touch, to the intent's memory of obstacles.
exploration::Intent felt(exploration::Intent intent, const PlanningInput& in, const Whereabouts& place,
                         std::span<const types::Vector2> going_at, bool touched, const PlannerParams& params);

/// Points of the front scanner within a few metres, without team-mates, in map.
std::vector<types::Vector2> seen_now(const PlanningInput& in, const Whereabouts& place,
                                     std::span<const types::Vector2> going_at, const PlannerParams& params);

/// Occupied cells of a map within a few metres that the front scanner sees to be free, as their centres.
std::vector<types::Vector2> seen_through(const PlanningInput& in, const Whereabouts& place,
                                         const grid::DenseMap& map, const travel::DrivenWays& ways,
                                         const PlannerParams& params);

}  // namespace topo::pipeline
