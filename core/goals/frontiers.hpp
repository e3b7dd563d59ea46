// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/grid/wavefront.hpp"
#include "core/types/se2.hpp"

namespace topo::goals {

/// A connected run (eight neighbours) of free cells that have unknown space at one of their four sides
/// (Yamauchi 1997).
struct Frontier {
  types::Vector2 centroid{0.0, 0.0};
  double width_m = 0.0;              ///< greater extent of its cells plus one cell
  std::vector<std::uint32_t> cells;  ///< indices into the map, ascending
};

/// All clusters at least `width_min_m` wide (0.75 m: what a robot can enter, and what explore_lite counts),
/// in the order of their first cells. Linear in the cells.
std::vector<Frontier> find_frontiers(const grid::DenseMap& map, double width_min_m = 0.75);

/// Of some cells the one nearest to their centroid, which may itself lie anywhere: a frontier can be a ring.
std::uint32_t middle_of(const grid::DenseMap& map, std::span<const std::uint32_t> cells);

/// Unknown space behind a frontier, as far as 1.2 m around the middle of its cells: m2, or HUGE_VAL when it
/// goes on beyond. Costs the cells of that square.
double unknown_behind_m2(const grid::DenseMap& map, const Frontier& frontier);

/// The cell from which a frontier is best visited: of the cells that the field reaches, the one with the
/// fewest steps over free cells to the frontier's cells, and of several the one nearest to the frontier's
/// centroid; nothing when none is within `within_m` of such steps. Costs the cells around the frontier.
std::optional<grid::CellIndex> approach_cell(const grid::DenseMap& map, const Frontier& frontier,
                                             const grid::TravelField& field, double within_m);

}  // namespace topo::goals
