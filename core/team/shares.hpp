// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "core/team/assignment.hpp"

namespace topo::team {

/// Goals of a team and the travel to them. Borrowed for the call.
struct SharedGoals {
  const CostTable& table;
  const Assignment& claims;  ///< the goal that each robot pursues
  /// Metres of travel between two goals of the table.
  const std::function<double(std::size_t, std::size_t)>& between_m;
  /// Way of a robot through its goals, over that through those known now: it finds others as it goes. Until
  /// 99 % are known, robots drive 1.3 to 2 times the tours of those who know the building (doc/results.md).
  double tours_grow = 2.0;
};

/// The goals of one robot, in the order of the table: those to which it is, or will be at its own goal,
/// nearest by travel; of equal ones the lower id's. A robot without any helps: it gets the goal at which it
/// is the longest before the robot whose goal that is, when that one visits its others on the way; none where
/// it would come later. Goals without a cost for this robot are not its own.
std::vector<std::size_t> share_of_goals(const SharedGoals& goals, std::size_t row);

}  // namespace topo::team
