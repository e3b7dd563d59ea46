// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "core/grid/dense_map.hpp"
#include "core/types/geometry.hpp"

namespace topo::goals {

/// The unknown space behind an opening as far as it can be judged from what has been seen.
struct SpaceBehind {
  double area_m2 = 0.0;  ///< unknown, connected to the opening, not beyond a wall or its continuation
  double ahead = 0.0;    ///< share of the rim of that space, without free cells, that is no wall
};

/// The unknown cells that are connected to an opening by their sides, within `reach_m` of its nearest cell,
/// bounded by occupied cells and `continued` walls (continued_walls.hpp). None when `reach_m` is less than
/// half a cell. Cost: the cells of the opening's box extended by `reach_m`, and the continued walls.
SpaceBehind space_behind(const grid::DenseMap& map, std::span<const std::uint32_t> opening,
                         std::span<const types::Segment> continued, double reach_m);

}  // namespace topo::goals
