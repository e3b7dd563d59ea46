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
  kOccupiedOrUnknown,  ///< only cells observed as free are open
};

/// Maximum side of a map in cells: 1.6 km at 0.05 m.
inline constexpr int kMaxSide = 32765;

/// Exact Euclidean distance from every cell's centre to the centre of the nearest boundary cell, in metres: 0
/// on boundary cells, infinity when there is no boundary. Linear time (Meijster, Roerdink and Hesselink 2000;
/// Felzenszwalb and Huttenlocher 2012). The result has the size of map.cells. Space outside the array is
/// boundary only for kOccupiedOrUnknown. Precondition: at most kMaxSide cells a side.
std::vector<float> clearance_m(const DenseMap& map, Boundary boundary);

}  // namespace topo::grid
