// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "core/team/assignment.hpp"

// Assignment rules from the literature, as baselines (core/team/assignment.hpp has the paper's). Without
// coordination every robot goes to its nearest frontier (Yamauchi 1998), which needs no rule here.
namespace topo::team {

/// In the order of ids, each robot gets its nearest goal that is not taken.
Assignment assign_in_turn(const CostTable& table);

/// True when two goals of a table are in sight of each other.
using InSight = std::function<bool(std::size_t, std::size_t)>;

/// Burgard et al., Coordinated multi-robot exploration, 2005, algorithm 1: the pair with the greatest utility
/// minus cost is assigned, and the utility of every goal is reduced by the probability that it is seen from
/// the assigned one: 1 - d / range within the scanner's range and in sight, else 0. Costs are in units of the
/// range, with weight 1. Several robots may get one goal when nothing better is left.
Assignment assign_by_utility(const CostTable& table, const InSight& in_sight, double range_m);

/// Bautin, Simonin and Charpillet, MinPos, 2012: each robot goes to the goal that the fewest other robots are
/// nearer to; of several, to the nearest. At equal distance the lower id counts as nearer.
Assignment assign_min_pos(const CostTable& table);

}  // namespace topo::team
