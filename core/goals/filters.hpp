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

/// Filter of internal boundaries: true when another place lies within internal_reach_m of the middle of
/// this side, along its normal.
bool faces_another_place(const GoalInput& input, std::uint16_t place, Side side, const GoalParams& params);

/// True when all cells on the straight line between the centres of two cells are free.
bool sees(const grid::DenseMap& map, grid::CellIndex a, grid::CellIndex b);

/// Distance from a point to the nearest pose of all paths; HUGE_VAL without poses. Linear in the poses.
double distance_from_paths_m(const types::Vector2& p_map, std::span<const std::vector<types::Vector2>> paths);

/// Pose-history filter: true when a robot has been at the goal. For an opening that is not wide
/// (wide_ratio) one pose within visited_radius_m is enough (paper: partial views through openings that a
/// robot cannot enter). For a wider one the paths (one per robot) must cover wide_travel_ratio times that
/// radius within it: a start with unknown space in the scanner's blind sector behind the robot must not count
/// as a visit.
bool is_visited(const Goal& goal, std::span<const std::vector<types::Vector2>> visited,
                const GoalParams& params);

}  // namespace topo::goals
