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

/// All frontiers at least `width_min_m` wide (0.75 m: the minimum that a robot can enter, and that
/// explore_lite counts), in the order of their first cells. Linear in the cells.
std::vector<Frontier> find_frontiers(const grid::DenseMap& map, double width_min_m = 0.75);

/// The one of the cells that is nearest to their centroid, which need not be one of them: a frontier can be a
/// ring.
std::uint32_t middle_of(const grid::DenseMap& map, std::span<const std::uint32_t> cells);

/// Area of the unknown space behind a frontier, m2, within `reach_m` of the middle of its cells along each
/// axis; HUGE_VAL when the space extends beyond. Cost: the cells of that square.
double unknown_behind_m2(const grid::DenseMap& map, const Frontier& frontier, double reach_m);

/// The cell from which to visit a frontier: of the cells that the field reaches, the one with the fewest
/// steps over free cells to the frontier's cells, and of several the one nearest to the frontier's centroid;
/// empty when none is within `within_m` in such steps. Cost: the cells around the frontier.
std::optional<grid::CellIndex> approach_cell(const grid::DenseMap& map, const Frontier& frontier,
                                             const grid::TravelField& field, double within_m);

}  // namespace topo::goals
