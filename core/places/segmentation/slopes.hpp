// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"

namespace topo::places {

/// Of a cell: the number of the neighbour, as in neighbour_offsets, with the steepest ascent of clearance, in
/// the bits below the flags.
using Slope = std::uint8_t;
inline constexpr Slope kFlat = 8;     ///< clearance rises nowhere
inline constexpr Slope kClosed = 16;  ///< the cell is not free, or at the array's border
inline constexpr Slope kNumber = 31;  ///< mask of the values above; the flags belong to the caller
inline constexpr Slope kOnAxis = 32;
inline constexpr Slope kVisited = 64;

/// The slopes of all cells, without flags. One pass over the cells.
std::vector<Slope> slopes_of(const grid::DenseMap& map, std::span<const float> clearance_m);

/// Renews the slopes of the given cells, ascending, and their neighbours; flags stay. Returns the cells whose
/// slope has changed.
std::vector<std::uint32_t> renew_slopes(const grid::DenseMap& map, std::span<const float> clearance_m,
                                        std::span<const std::uint32_t> cells, std::vector<Slope>& slopes);

}  // namespace topo::places
