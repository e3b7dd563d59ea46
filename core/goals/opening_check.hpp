// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "core/goals/essential_goals.hpp"

namespace topo::goals {

/// Opening check: can the robot's disc, as far as anything occupied is known, go on through the opening for
/// behind_m into unknown space, of which at least behind_m2 can be had so? Shadows of furniture, slots and
/// niches are less. Costs the cells of the opening's box and as far around it.
bool leads_to_unknown(const grid::DenseMap& map, std::span<const std::uint32_t> opening,
                      const GoalParams& params);

}  // namespace topo::goals
