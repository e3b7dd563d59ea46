// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/grid/cell.hpp"
#include "core/patricia/cow.hpp"

namespace topo::grid {

/// Evidence of one cell: the number of keyframes with a ray that ends in it, and of keyframes with rays that
/// only pass through it. Integers, so that the sum does not depend on the order of keyframes, and a keyframe
/// can be removed exactly.
struct CellCounts {
  std::uint16_t hits = 0;
  std::uint16_t misses = 0;
  friend bool operator==(const CellCounts&, const CellCounts&) = default;
};

/// Occupied when at least a quarter of the evidence is hits: beams that graze a thin wall pass through its
/// cells. Hits and misses have the weights of log-odds of 1.1 and -0.37 (Thrun et al., section 9.2), without
/// saturation. Not a parameter: it is what a map's cell means to every reader of its tiles.
constexpr CellState state_of(const CellCounts& counts) {
  const unsigned hits = counts.hits, all = hits + counts.misses;
  if (all == 0) return CellState::kUnknown;
  return 4 * hits >= all ? CellState::kOccupied : CellState::kFree;
}

/// Square block of cells, the unit of copying: 4 KiB, one page.
struct Tile {
  static constexpr int kSide = 32;
  std::array<CellCounts, static_cast<std::size_t>(kSide) * kSide> cells{};

  [[nodiscard]] static constexpr std::size_t index(int x, int y) {
    return static_cast<std::size_t>(y * kSide + x);
  }
};

using TileRef = patricia::Cow<Tile>;

}  // namespace topo::grid
