// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>

namespace topo::walls {

/// Heights above the floor in slabs of 0.1 m, one bit each, from 0 to 3.2 m (DESIGN "Wall store").
using Slabs = std::uint32_t;
inline constexpr double kSlabHeight_m = 0.1;
inline constexpr int kSlabs = 32;

/// The slab of a height, or no bit outside 0 to 3.2 m.
constexpr Slabs slab_of(double height_m) {
  const double slab = height_m / kSlabHeight_m;
  return slab >= 0.0 && slab < kSlabs ? Slabs{1} << static_cast<int>(slab) : Slabs{0};
}

/// Heights at which a wall is occupied (paper section II-B): three, at least half a metre apart. Furniture
/// rarely is.
struct WallHeights {
  int count_min = 3;
  int apart_slabs = 5;
  friend bool operator==(const WallHeights&, const WallHeights&) = default;
};

/// True when occupied at enough different heights.
constexpr bool is_wall(Slabs slabs, const WallHeights& params = {}) {
  int heights = 0;
  while (slabs != 0) {
    const int lowest = std::countr_zero(slabs);
    ++heights;
    if (lowest + params.apart_slabs >= kSlabs) break;
    slabs &= ~Slabs{0} << (lowest + params.apart_slabs);
  }
  return heights >= params.count_min;
}

/// Heights seen at one position, in the frame of the keyframe that contains it.
struct ColumnPoint {
  float x_m = 0.0F;
  float y_m = 0.0F;
  Slabs slabs = 0;
};

}  // namespace topo::walls
