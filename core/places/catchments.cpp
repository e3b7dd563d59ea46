// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/catchments.hpp"

#include <algorithm>

#include "core/places/erosion.hpp"

namespace topo::places {

Catchments::Catchments(const grid::DenseMap& map, std::vector<Slope>& slopes)
    : slopes_(slopes.data()),
      width_(static_cast<std::uint32_t>(map.width())),
      offsets_(neighbour_offsets(map)),
      rows_(static_cast<std::size_t>(map.height())) {}

void Catchments::spread_from(std::uint32_t cell) {
  visit(cell);
  for (std::size_t k = 0; k < 8; ++k) visit(beside(cell, k));
  spread();
}

void Catchments::visit(std::uint32_t i) {
  if ((slopes_[i] & (kOnAxis | kVisited | kClosed)) != 0) return;
  slopes_[i] |= kVisited;
  queue_.push_back(i);
}

void Catchments::spread() {
  while (!queue_.empty()) {
    const std::uint32_t i = queue_.back();
    queue_.pop_back();
    Span& row = rows_[i / width_];
    row = {std::min(row.first, i), std::max(row.end, i + 1)};
    const Slope up = slopes_[i] & kNumber;
    for (std::size_t k = 0; k < 8; ++k) {
      const std::uint32_t j = beside(i, k);
      const Slope from = slopes_[j] & kNumber;
      if (up == kFlat || up == k || from == kFlat || from == (k + 4) % 8) visit(j);
    }
  }
}

}  // namespace topo::places
