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

/// Free space while it is thinned to its axis. Cells at the array's border count as not free.
struct Thinning {
  std::vector<std::uint8_t> marks;    ///< kOn and kRidge, as map.cells
  std::vector<std::uint32_t> remain;  ///< the cells that are on, in rising order of clearance

  static constexpr std::uint8_t kOn = 1;     ///< not yet taken away
  static constexpr std::uint8_t kRidge = 2;  ///< of the distance map: an end here is meant
  static constexpr std::uint8_t kQueued = 4;
  static constexpr std::uint8_t kKept = 8;  ///< its turn came, and it stayed
};

/// Takes cells away in rising order of clearance as long as neither components nor holes change (distance-
/// ordered homotopic thinning, Pudney 1998), down to the ridge of the distance map and what connects it.
Thinning thin_to_ridge(const grid::DenseMap& map, std::span<const float> clearance_m);

/// Takes away every cell that is not needed for connection, apart from ends on the ridge, until none is left.
void thin_to_lines(const grid::DenseMap& map, Thinning& thinning);

}  // namespace topo::places
