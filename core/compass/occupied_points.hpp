// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/types/geometry.hpp"

namespace topo::compass {

/// Centres of the occupied cells with a straight neighbour that is not occupied, row by row. The inside of a
/// solid mass, as in drawn maps, carries no information about walls and can be most of the map.
std::vector<types::Vector2> occupied_points(const grid::DenseMap& map);

}  // namespace topo::compass
