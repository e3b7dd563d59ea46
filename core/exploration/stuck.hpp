// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/exploration/intent.hpp"
#include "core/exploration/params.hpp"

namespace topo::exploration {

/// The robot did not get on here: whatever stands ahead, the next route leads round it. A passage that is too
/// tight stays closed for the mission.
Intent block_ahead(const Situation& situation, const travel::RouteMap& map, const PursuitParams& params,
                   Intent intent);

/// The pursuit after going on towards a place: a cell near it as target, if one is reachable.
Pursuit aimed_at(const types::Vector2& p_map, travel::RouteMap& map, Pursuit pursuit);

}  // namespace topo::exploration
