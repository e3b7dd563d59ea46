// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/grid/dense_map.hpp"
#include "core/types/geometry.hpp"

namespace topo::places {

/// The map without what stands about in its free space: connected cells (eight neighbours) that are not free,
/// surrounded by free space, no longer than `furniture_m` along either axis, become free. Chairs, tables,
/// boxes and their shadows say nothing of a building's structure (paper section II-D), and with them every
/// room is a maze. What lies along one of the walls stays: of a wall behind shelves only pieces are seen.
/// Linear in the cells.
grid::DenseMap without_furniture(const grid::DenseMap& map, std::span<const types::Segment> walls,
                                 double furniture_m);

}  // namespace topo::places
