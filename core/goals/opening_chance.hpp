// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/goals/space_behind.hpp"

namespace topo::goals {

/// The probability that an opening leads onto a large area, 10 m2 or more: how much of a half disc of
/// `reach_m` is unknown behind it, times the share of that space's rim at which it goes on. Nothing in it is
/// fitted. On openings of partial maps of buildings that were drawn afterwards it is right to 0.1 where it
/// is said to be anything from 0 to 1 (doc/results.md). The distance from the paths, the width and the
/// clearance for the robot's disc, which a former rule was made of, add little to it.
double chance_to_lead_on(const SpaceBehind& space, double reach_m);

}  // namespace topo::goals
