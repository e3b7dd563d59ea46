// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/grid/dense_map.hpp"
#include "core/types/geometry.hpp"

namespace topo::places {

/// The map without furniture: connected cells (eight neighbours) that are not free, are surrounded by free
/// space and are at most `furniture_m` long along both axes become free. Chairs, tables, boxes and their
/// shadows are not part of a building's structure (paper section II-D), and they turn every room into a maze.
/// Cells along one of the walls stay: of a wall behind shelves only pieces are visible. Linear in the cells.
grid::DenseMap without_furniture(const grid::DenseMap& map, std::span<const types::Segment> walls,
                                 double furniture_m);

}  // namespace topo::places
