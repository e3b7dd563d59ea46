// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/places/skeleton/erosion.hpp"

namespace topo::places {

/// Number of bits set in a pattern of neighbours; not every processor has an instruction for it.
inline int bits_set(unsigned pattern) {
  static constexpr std::array<std::uint8_t, 256> kBitsSet = [] {
    std::array<std::uint8_t, 256> table{};
    for (unsigned p = 0; p < 256; ++p) table[p] = static_cast<std::uint8_t>(std::popcount(p));
    return table;
  }();
  return kBitsSet[pattern];
}

/// Distance to a cell's neighbour in a direction, as in neighbour_offsets.
inline float step_m(const grid::DenseMap& map, std::size_t direction) {
  return static_cast<float>(map.resolution_m * (direction % 2 == 0 ? 1.0 : 1.41421356));
}

/// Free space during thinning to its axis. Cells at the array's border count as not free.
struct Thinning {
  std::vector<std::uint8_t> marks;  ///< as map.cells
  /// The cells that are on, in ascending order of clearance, and those removed since the last thinning.
  std::vector<std::uint32_t> remain;

  static constexpr std::uint8_t kOn = 1;       ///< not removed
  static constexpr std::uint8_t kRidge = 2;    ///< of the distance map: an end here stays
  static constexpr std::uint8_t kDoubted = 4;  ///< may be removable: not examined in its present state
  static constexpr std::uint8_t kNode = 8;     ///< part of a node, or of an edge, of the graph
  static constexpr std::uint8_t kEdge = 16;
  static constexpr std::uint8_t kAhead = 32;  ///< its turn is still to come; set before all turns

  /// Removes a cell, and puts its neighbours in doubt. Calls come(neighbour) for each that was not.
  template <class F>
  void take_away(std::uint32_t cell, const std::array<std::ptrdiff_t, 8>& offsets, F&& come) {
    marks[cell] = 0;
    for (const std::ptrdiff_t offset : offsets) {
      const auto beside = static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(cell) + offset);
      if ((marks[beside] & (kOn | kDoubted)) != kOn) continue;
      marks[beside] |= kDoubted;
      come(beside);
    }
  }

  /// The neighbours of a cell that are on; bit k: the one at offsets[k].
  [[nodiscard]] unsigned pattern_at(std::uint32_t cell, const std::array<std::ptrdiff_t, 8>& offsets) const {
    static_assert(std::endian::native == std::endian::little && kOn == 1);
    const std::uint8_t *const mark = marks.data() + cell, *const south_west = mark + offsets[5],
                              *const north_east = mark + offsets[1];
    // Three neighbours in one word, one byte each, with an unused fourth; a product moves their lowest bits
    // together.
    constexpr std::uint32_t kOns = 0x010101, kRising = 1U << 16U | 1U << 9U | 1U << 2U,
                            kFalling = 1U << 18U | 1U << 9U | 1U;
    std::uint32_t south = 0, north = 0;
    std::memcpy(&south, south_west, sizeof south);
    std::memcpy(&north, north_east - 3, sizeof north);
    const std::uint32_t below = (south & kOns) * kRising >> 16U & 7U;
    const std::uint32_t above = (north >> 8U & kOns) * kFalling >> 16U & 7U;
    return (mark[1] & unsigned{kOn}) | above << 1U | (mark[-1] & unsigned{kOn}) << 4U | below << 5U;
  }
  [[nodiscard]] int count_around(std::uint32_t cell, const std::array<std::ptrdiff_t, 8>& offsets) const {
    return bits_set(pattern_at(cell, offsets));
  }
};

/// Prefetches the rows around a cell that is examined soon: cells in ascending order of clearance are
/// scattered over the map.
inline void fetch_around(const Thinning& thinning, std::uint32_t cell,
                         const std::array<std::ptrdiff_t, 8>& offsets) {
  const std::uint8_t* const mark = thinning.marks.data() + cell;
  for (const std::ptrdiff_t row : {offsets[6], std::ptrdiff_t{0}, offsets[2]}) __builtin_prefetch(mark + row);
}

/// Begins thinning with the cells that erosion keeps, all of them in doubt.
Thinning thin_to_ridge(const grid::DenseMap& map, const Erosion& erosion);

/// Removes every cell that is not needed for connection, except ends on the ridge, until no cell is removable
/// or in doubt.
void thin_to_lines(const grid::DenseMap& map, Thinning& thinning);

}  // namespace topo::places
