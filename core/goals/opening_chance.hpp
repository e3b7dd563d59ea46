// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/goals/space_behind.hpp"

namespace topo::goals {

/// The probability that an opening leads onto a large area, 10 m2 or more that a robot can reach: how much of
/// a half disc of `reach_m` is unknown behind it, times the share of that space's rim at which it goes on.
/// Nothing in it is fitted. How often openings of each chance do lead on is in doc/results.md. Precondition:
/// reach_m > 0.
double chance_to_lead_on(const SpaceBehind& space, double reach_m);

}  // namespace topo::goals
