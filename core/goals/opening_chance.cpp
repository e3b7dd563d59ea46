// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/opening_chance.hpp"

#include <algorithm>
#include <numbers>

namespace topo::goals {

double chance_to_lead_on(const SpaceBehind& space, double reach_m) {
  const double half_disc_m2 = 0.5 * std::numbers::pi * reach_m * reach_m;
  return std::min(space.area_m2 / half_disc_m2, 1.0) * space.ahead;
}

}  // namespace topo::goals
