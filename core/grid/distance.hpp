// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/grid/dense_map.hpp"

namespace topo::grid {

/// What bounds free space.
enum class Boundary : std::uint8_t {
  kOccupied,           ///< unknown is open
  kOccupiedOrUnknown,  ///< only what was seen to be free is open
};

/// Of a map in cells: 1.6 km of 0.05 m.
inline constexpr int kMaxSide = 32765;

/// Exact Euclidean distance from every cell's centre to the centre of the nearest boundary cell, in metres:
/// 0 on boundary cells. Linear time (Meijster, Roerdink and Hesselink 2000; Felzenszwalb and Huttenlocher
/// 2012). As long as map.cells. What lies outside the array is boundary only for kOccupiedOrUnknown. Infinity
/// where there is no boundary at all. Precondition: at most kMaxSide cells a side.
std::vector<float> clearance_m(const DenseMap& map, Boundary boundary);

}  // namespace topo::grid
