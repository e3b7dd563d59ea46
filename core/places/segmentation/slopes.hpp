// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"

namespace topo::places {

/// Of a cell: the number of the neighbour, as in neighbour_offsets, to which clearance rises most, below
/// flags.
using Slope = std::uint8_t;
inline constexpr Slope kFlat = 8;     ///< it rises nowhere
inline constexpr Slope kClosed = 16;  ///< the cell is not free, or at the array's border
inline constexpr Slope kNumber = 31;  ///< these; the flags are whose the slopes are
inline constexpr Slope kOnAxis = 32;
inline constexpr Slope kVisited = 64;

/// Of all cells, without flags. One pass over the cells.
std::vector<Slope> slopes_of(const grid::DenseMap& map, std::span<const float> clearance_m);

/// The same of the given cells, ascending, and all beside them; flags stay. Returns whose are other ones.
std::vector<std::uint32_t> renew_slopes(const grid::DenseMap& map, std::span<const float> clearance_m,
                                        std::span<const std::uint32_t> cells, std::vector<Slope>& slopes);

}  // namespace topo::places
