// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/exploration/intent.hpp"
#include "core/exploration/params.hpp"

namespace topo::exploration {

/// The robot is stuck: blocks the obstacle ahead, so that the next route leads round it. A passage that is
/// too tight stays closed for the mission.
Intent block_ahead(const Situation& situation, const travel::RouteMap& map, const PursuitParams& params,
                   Intent intent);

/// Sets the target of a pursuit to a reachable cell near a position, if there is one.
Pursuit aimed_at(const types::Vector2& p_map, travel::RouteMap& map, Pursuit pursuit);

}  // namespace topo::exploration
