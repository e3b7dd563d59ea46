// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/types/geometry.hpp"

namespace topo::goals {

/// How walls are continued where they have not been seen.
struct ContinuedWallParams {
  double length_m = 1.2;  ///< at most; 0.6 to 30 m were tried (doc/results.md)
  double jamb_m = 0.4;    ///< free cells so near to the end of a wall do not stop it: its end is not exact
};

/// Both ends of each wall continued straight until the first free cell, from the wall outwards; in the order
/// of the walls. The shadow of an object at a wall mostly ends where that wall goes on behind it. Cost: the
/// cells of the continuations.
std::vector<types::Segment> continued_walls(const grid::DenseMap& map, std::span<const types::Segment> walls,
                                            const ContinuedWallParams& params = {});

}  // namespace topo::goals
