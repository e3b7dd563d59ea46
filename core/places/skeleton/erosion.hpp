// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"

namespace topo::places {

/// Offsets of the eight neighbours in a map's array, counter-clockwise from east: the even ones share a side.
std::array<std::ptrdiff_t, 8> neighbour_offsets(const grid::DenseMap& map);

/// Free space after distance-ordered homotopic thinning (Pudney 1998): cells are removed in ascending order
/// of clearance as long as neither components nor holes change. The ridge of the distance map and its
/// connections remain. Cells at the array's border count as not free. A value; empty: of no map.
struct Erosion {
  grid::CellBox box;  ///< of the map
  /// Bucket of clearance and state of every cell of the map; 0 for cells that are not free.
  std::vector<std::uint16_t> states;
  std::vector<std::uint32_t> kept;  ///< in the order of their turns

  static constexpr std::uint16_t kRidge = 2;    ///< of the distance map: always kept
  static constexpr std::uint16_t kKept = 4;     ///< kept at its turn
  static constexpr std::uint16_t kDelayed = 8;  ///< its turn came after those of all others of its bucket
};

/// `clearance_m`: grid::clearance_m of the map with kOccupiedOrUnknown; no cell at the array's border is
/// free. Costs a pass over the cells, and more for those on the ridge and beside kept ones.
Erosion erode(const grid::DenseMap& map, std::span<const float> clearance_m);

}  // namespace topo::places
