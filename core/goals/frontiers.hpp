// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/grid/wavefront.hpp"
#include "core/types/se2.hpp"

namespace topo::goals {

/// A connected run of free cells that touch unknown space (Yamauchi 1997).
struct Frontier {
  types::Vector2 centroid{0.0, 0.0};
  double width_m = 0.0;              ///< greater extent of its cells plus one cell
  std::vector<std::uint32_t> cells;  ///< indices into the map
};

/// All clusters at least `width_min_m` wide (0.75 m: what a robot can enter, and what explore_lite counts),
/// in the order of their first cells.
std::vector<Frontier> find_frontiers(const grid::DenseMap& map, double width_min_m = 0.75);

/// The cell from which a frontier is best visited: reachable, nearest in travel to the frontier's cells with
/// at least the rules' clearance; nothing when no cell within `within_m` of the frontier can be reached.
std::optional<grid::CellIndex> approach_cell(const grid::DenseMap& map, const Frontier& frontier,
                                             const grid::TravelField& field, double within_m);

}  // namespace topo::goals
