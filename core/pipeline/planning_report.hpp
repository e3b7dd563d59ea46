// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>

#include "core/exploration/intent.hpp"
#include "core/pipeline/planning_step.hpp"
#include "core/pipeline/whereabouts.hpp"

// Output of a planning step: for the base, for displays, and for team-mates.
namespace topo::pipeline {

/// The operator's view of a phase. `is_hindered`: nothing can be planned now.
Activity activity_of(const exploration::Phase& phase, bool has_goal, bool is_hindered);

Plan make_plan(std::uint64_t sequence, const PlanningInput& in, const exploration::Intent& intent,
               const Whereabouts& place, std::span<const types::Vector2> route,
               const exploration::TeamView& team, const PlannerParams& params);

/// Without the parts from the map and the analysis.
std::unique_ptr<PlanningReport> make_report(const PlanningInput& in, const exploration::Intent& intent,
                                            const Whereabouts& place, std::span<const types::Vector2> route);

team::StatusMessage make_message(const PlanningInput& in, const exploration::Intent& intent,
                                 const Whereabouts& place, std::span<const types::Vector2> route,
                                 const PlannerParams& params);

}  // namespace topo::pipeline
