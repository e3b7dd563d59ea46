// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "core/goals/essential_goals.hpp"

namespace topo::goals {

/// Opening check: true when the robot's disc, avoiding all known occupied cells, can move through the opening
/// and on for behind_m into unknown space, and can reach at least behind_m2 of it. Shadows of furniture,
/// slots and niches are smaller. Cost: the cells of the opening's box extended by behind_m or
/// look_m.
bool leads_to_unknown(const grid::DenseMap& map, std::span<const std::uint32_t> opening,
                      const GoalParams& params);

}  // namespace topo::goals
