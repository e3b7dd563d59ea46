// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/slopes.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "core/grid/cell_block.hpp"

namespace topo::places {
namespace {

using grid::CellState;
using grid::DenseMap;
using grid::kCellBlock;

/// Slopes of free cells with clearances `at`, in rows of `width`. None leads through the corner where two
/// walls meet.
void point_up(const float* at, std::size_t width, std::size_t count, Slope* slopes) {
  const float *const low = at - width, *const high = at + width;
  std::array<std::int32_t, kCellBlock> numbers{};
  for (std::size_t i = 0; i < count; ++i) {
    const float here = at[i];
    const float east = at[i + 1], west = at[i - 1], north = high[i], south = low[i];
    const float level = east >= west ? east : west, upright = north >= south ? north : south;
    const float north_east = high[i + 1], north_west = high[i - 1], south_east = low[i + 1],
                south_west = low[i - 1];
    const float high_corner = east >= west ? north_east : north_west,
                low_corner = east >= west ? south_east : south_west;
    const float diagonal = north >= south ? high_corner : low_corner;
    const float side = (level < upright ? upright : level) - here;
    // The steepest diagonal lies between the two sides with the steeper ascent.
    const float open = level < upright ? upright : level;
    const float corner = open > 0.0F ? (diagonal - here) * 0.70711F : 0.0F;
    const int to_level = east >= west ? 0 : 4, to_upright = north >= south ? 2 : 6;
    const int high_number = east >= west ? 1 : 3, low_number = east >= west ? 7 : 5;
    const int to_corner = north >= south ? high_number : low_number;
    const int to_side = level >= upright ? to_level : to_upright;
    const int not_corner = side > 0.0F ? to_side : int{kFlat};
    const float other = side > 0.0F ? side : 0.0F;
    numbers[i] = corner > other ? to_corner : not_corner;
  }
  for (std::size_t i = 0; i < count; ++i) slopes[i] = static_cast<Slope>(numbers[i]);
}

}  // namespace

std::vector<Slope> slopes_of(const DenseMap& map, std::span<const float> clearance_m) {
  std::vector<Slope> slopes(map.cells.size(), kClosed);
  const auto width = static_cast<std::size_t>(map.width()), height = static_cast<std::size_t>(map.height());
  for (std::size_t y = 1; y + 1 < height; ++y) {
    for (std::size_t x = 1; x + 1 < width; x += kCellBlock) {
      const std::size_t first = y * width + x, count = std::min(kCellBlock, width - 1 - x);
      const CellState* const state = &map.cells[first];
      if (std::memchr(state, static_cast<int>(CellState::kFree), count) == nullptr) continue;
      point_up(&clearance_m[first], width, count, &slopes[first]);
      for (std::size_t i = 0; i < count; ++i)
        slopes[first + i] = state[i] == CellState::kFree ? slopes[first + i] : kClosed;
    }
  }
  return slopes;
}

}  // namespace topo::places
