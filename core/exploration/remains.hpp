// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/exploration/intent.hpp"
#include "core/exploration/params.hpp"

namespace topo::exploration {

/// Notes what an exploration that ends leaves: goals that are not worth their time, "left out: 0.4 m2 for 31
/// s", and openings that are too narrow for the robot where the building goes on behind, "too narrow: an
/// opening of 0.58 m, 0.60 m needed".
Intent note_what_remains(const Situation& situation, travel::RouteMap& map, const ExplorationParams& params,
                         Intent intent);

}  // namespace topo::exploration
