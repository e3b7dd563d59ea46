// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/pipeline/planning_memory.hpp"

// The first part of a planning step: orders, team-mates, battery, and what sonar, bumpers and scanner
// noticed.
namespace topo::pipeline {

/// The intent after the operator's orders. `mission`: number of the one before.
exploration::Intent ordered(exploration::Intent intent, std::uint64_t mission, const PlanningInput& in);

struct Heard {
  Team team;
  team::LastContact contact;
};

/// After the messages of this period. `here`: where the robot was last.
Heard heard(Heard before, const PlanningInput& in, const types::Vector2& here);

Battery watched(Battery battery, const ControlReport& control, const types::BatteryLimits& limits,
                types::Stamp now);

/// With the echoes of this period, and the touch if there was one, in its memory of obstacles.
exploration::Intent felt(exploration::Intent intent, const PlanningInput& in, const Whereabouts& place,
                         std::span<const types::Vector2> going_at, bool touched);

/// What the front scanner sees within a few metres now, team-mates left out, in map.
std::vector<types::Vector2> seen_now(const PlanningInput& in, const Whereabouts& place,
                                     std::span<const types::Vector2> going_at, const PlannerParams& params);

}  // namespace topo::pipeline
