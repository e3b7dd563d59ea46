// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"

namespace topo::places {

/// Of a cell: the number of the neighbour, as in neighbour_offsets, with the steepest ascent of clearance.
using Slope = std::uint8_t;
inline constexpr Slope kFlat = 8;     ///< clearance rises nowhere
inline constexpr Slope kClosed = 16;  ///< the cell is not free, or at the array's border

/// The slopes of all cells. One pass over the cells.
std::vector<Slope> slopes_of(const grid::DenseMap& map, std::span<const float> clearance_m);

}  // namespace topo::places
