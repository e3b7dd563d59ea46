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

/// The eight neighbours' offsets in a map's array, counter-clockwise from east: the even ones share a side.
std::array<std::ptrdiff_t, 8> neighbour_offsets(const grid::DenseMap& map);

/// Free space without what can be taken away in rising order of clearance as long as neither components nor
/// holes change (distance-ordered homotopic thinning, Pudney 1998): the ridge of the distance map and what
/// connects it. Cells at the array's border count as not free. A value; empty: of no map.
struct Erosion {
  grid::CellBox box;  ///< of the map
  /// Of every cell of the map: its bucket of clearance, and its state; 0 where it is not free.
  std::vector<std::uint16_t> states;
  std::vector<std::uint32_t> kept;  ///< in the order in which their turns came

  static constexpr std::uint16_t kRidge = 2;    ///< of the distance map: stays whatever is around it
  static constexpr std::uint16_t kKept = 4;     ///< its turn came, and it stayed
  static constexpr std::uint16_t kDelayed = 8;  ///< its turn came after all others of its bucket
};

/// `clearance_m`: grid::clearance_m of the map with kOccupiedOrUnknown; nothing on the array's border is
/// free. A pass over the cells, and some work for those on the ridge and beside what stays.
Erosion erode(const grid::DenseMap& map, std::span<const float> clearance_m);

/// The same from the erosion of another map, of the same resolution and with a box inside of this one's:
/// equal to that of the whole map when `changed` has all cells whose clearance is not what it was there,
/// those outside of it counted as none, ascending. Costs what has changed, and a pass over the cells for what
/// is kept.
Erosion erode_again(const grid::DenseMap& map, std::span<const float> clearance_m, Erosion before,
                    std::span<const std::uint32_t> changed);

}  // namespace topo::places
