// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "core/team/assignment.hpp"

// Rules of others, to be measured against (core/team/assignment.hpp has the paper's). Without coordination
// every robot goes to its nearest frontier (Yamauchi 1998), which needs no rule here.
namespace topo::team {

/// In turn, by id, each robot is given the nearest goal that is not taken.
Assignment assign_in_turn(const CostTable& table);

/// Are two goals of a table in sight of each other?
using InSight = std::function<bool(std::size_t, std::size_t)>;

/// Burgard et al., Coordinated multi-robot exploration, 2005, algorithm 1: the pair with the greatest utility
/// less cost is taken, and the utility of the other goals falls by the probability that they are seen from
/// the one taken: 1 - d / range within the scanner's range and in sight, else 0. Costs count in ranges, with
/// their weight of 1. Several robots may get one goal when nothing better is left.
Assignment assign_by_utility(const CostTable& table, const InSight& in_sight, double range_m);

/// Bautin, Simonin and Charpillet, MinPos, 2012: each robot goes where the fewest others are nearer; of
/// several such goals to the nearest. Equally near: the lower id is nearer.
Assignment assign_min_pos(const CostTable& table);

}  // namespace topo::team
