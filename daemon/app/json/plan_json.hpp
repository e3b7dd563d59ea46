// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/pipeline/planning_step.hpp"
#include "daemon/control/json_rpc.hpp"

namespace topo::daemon {

// What planning knows, for topoctl and for files. Lengths in metres in map, ages in seconds before the
// report.

/// The goal in hand, the open ones, those put off (back_in_s null: for good), the candidates that were
/// dropped with the reason, and the last decisions.
Json goals_json(const pipeline::PlanningReport& report);

/// The places with their number, middle, area and open goals, and which touch.
Json places_json(const pipeline::PlanningReport& report);

/// One goal; null when there is none.
Json goal_json(const std::optional<goals::Goal>& goal);

}  // namespace topo::daemon
