// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/places/erosion.hpp"

namespace topo::places {

/// Free space while it is thinned to its axis. Cells at the array's border count as not free.
struct Thinning {
  std::vector<std::uint8_t> marks;    ///< as map.cells
  std::vector<std::uint32_t> remain;  ///< the cells that are on, in rising order of clearance

  static constexpr std::uint8_t kOn = 1;     ///< not yet taken away
  static constexpr std::uint8_t kRidge = 2;  ///< of the distance map: an end here is meant
  static constexpr std::uint8_t kQueued = 4;
  static constexpr std::uint8_t kNode = 8;  ///< part of a node, or of an edge, of the graph
  static constexpr std::uint8_t kEdge = 16;

  /// Which of a cell's neighbours are on; bit k: that at offsets[k].
  [[nodiscard]] unsigned pattern_at(std::uint32_t cell, const std::array<std::ptrdiff_t, 8>& offsets) const {
    const std::uint8_t* const mark = marks.data() + cell;
    unsigned pattern = 0;
    for (unsigned k = 0; k < 8; ++k) pattern |= (mark[offsets[k]] & unsigned{kOn}) << k;
    return pattern;
  }
};

/// The rows around a cell that will be looked at soon: cells in rising order of clearance lie all over the
/// map.
inline void fetch_around(const Thinning& thinning, std::uint32_t cell,
                         const std::array<std::ptrdiff_t, 8>& offsets) {
  const std::uint8_t* const mark = thinning.marks.data() + cell;
  for (const std::ptrdiff_t row : {offsets[6], std::ptrdiff_t{0}, offsets[2]}) __builtin_prefetch(mark + row);
}
/// So many cells before.
inline constexpr std::size_t kFetchAhead = 12;

/// Thinning begins with what erosion keeps.
Thinning thin_to_ridge(const grid::DenseMap& map, const Erosion& erosion);

/// Takes away every cell that is not needed for connection, apart from ends on the ridge, until none is left.
void thin_to_lines(const grid::DenseMap& map, Thinning& thinning);

}  // namespace topo::places
