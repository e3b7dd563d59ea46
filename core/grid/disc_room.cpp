// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/grid/disc_room.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace topo::grid {
namespace {

/// Half the width of each row of a disc, from the middle row outwards, without empty rows.
std::vector<std::int32_t> half_widths(double radius) {
  std::vector<std::int32_t> half;
  for (double v = 0.0; radius * radius - v * v > 0.0; v += 1.0)
    half.push_back(static_cast<std::int32_t>(std::ceil(std::sqrt(radius * radius - v * v))) - 1);
  return half;
}

}  // namespace

DiscRoom::DiscRoom(const DenseMap& map, const CellBox& box, double radius_m)
    : box_(box), closed_(static_cast<std::size_t>(box.width() * box.height()), 0) {
  const std::vector<std::int32_t> half = half_widths(radius_m / map.resolution_m);
  const auto reach = static_cast<std::int32_t>(half.size()) - 1;
  const std::int32_t y_from = std::max(box.min.y - reach, map.box.min.y);
  const std::int32_t y_to = std::min(box.max.y + reach, map.box.max.y);
  const std::int32_t x_from = std::max(box.min.x - reach, map.box.min.x);
  const std::int32_t x_to = std::min(box.max.x + reach, map.box.max.x);
  for (std::int32_t y = y_from; y <= y_to && x_from <= x_to; ++y) {
    const CellState* const row = &map.cells[map.index({x_from, y})];
    for (std::int32_t x = 0; x <= x_to - x_from; ++x) {
      if (row[x] != CellState::kOccupied) continue;
      const std::int32_t first = x;
      while (x < x_to - x_from && row[x + 1] == CellState::kOccupied) ++x;
      close_around(y, x_from + first, x_from + x, half);
    }
  }
}

void DiscRoom::close_around(std::int32_t y, std::int32_t first, std::int32_t last,
                            std::span<const std::int32_t> half) {
  const auto reach = static_cast<std::int32_t>(half.size()) - 1;
  for (std::int32_t v = -reach; v <= reach; ++v) {
    if (y + v < box_.min.y || y + v > box_.max.y) continue;
    const std::int32_t wide = half[static_cast<std::size_t>(std::abs(v))];
    const std::int32_t from = std::max(first - wide, box_.min.x), to = std::min(last + wide, box_.max.x);
    if (from <= to) std::fill_n(&closed_[index({from, y + v})], to - from + 1, std::uint8_t{1});
  }
}

}  // namespace topo::grid
