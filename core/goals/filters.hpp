// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/goals/essential_goals.hpp"
#include "core/goals/openings.hpp"

namespace topo::goals {

/// Internal boundaries: is there another place right behind the middle of this side?
bool faces_another_place(const GoalInput& input, std::uint16_t place, Side side);

/// Is everything free on the straight line between two cells' centres?
bool sees(const grid::DenseMap& map, grid::CellIndex a, grid::CellIndex b);

/// Pose-history filter: has a robot been there? For an opening of less than twice the least width one pose
/// within visited_radius_m is enough (paper: partial views through openings that a robot cannot enter). For
/// a wider one the paths, a robot's each, must go 1.2 times that far within it: a start with unknown space in
/// the scanner's blind sector behind the robot must not count as a visit.
bool is_visited(const Goal& goal, std::span<const std::vector<types::Vector2>> visited,
                const GoalParams& params);

}  // namespace topo::goals
