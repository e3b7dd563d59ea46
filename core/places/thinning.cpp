// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/thinning.hpp"

#include <algorithm>

#include "core/places/simple_cell.hpp"

namespace topo::places {
using grid::DenseMap;

Thinning thin_to_ridge(const DenseMap& map, const Erosion& erosion) {
  Thinning thinning{std::vector<std::uint8_t>(map.cells.size(), 0), erosion.kept};
  for (const std::uint32_t i : erosion.kept) {
    const bool ridge = (erosion.fates[i] & Erosion::kRidge) != 0;
    thinning.marks[i] = ridge ? Thinning::kOn | Thinning::kRidge : Thinning::kOn;
  }
  return thinning;
}

void thin_to_lines(const DenseMap& map, Thinning& thinning) {
  auto& marks = thinning.marks;
  const auto offsets = neighbour_offsets(map);
  std::vector<std::uint32_t> queue = thinning.remain;
  for (const std::uint32_t i : queue) marks[i] |= Thinning::kQueued;
  // A cell that must stay now may go when a neighbour is gone: every change brings its neighbours back.
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const std::uint32_t i = queue[next];
    if (next + kFetchAhead < queue.size()) fetch_around(thinning, queue[next + kFetchAhead], offsets);
    marks[i] &= static_cast<std::uint8_t>(~Thinning::kQueued);
    const unsigned pattern = thinning.pattern_at(i, offsets);
    const bool end = (marks[i] & Thinning::kRidge) != 0 && (pattern & (pattern - 1)) == 0;
    if (end || !is_simple(pattern)) continue;
    marks[i] = 0;
    for (const std::ptrdiff_t offset : offsets) {
      const auto j = static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(i) + offset);
      if ((marks[j] & (Thinning::kOn | Thinning::kQueued)) != Thinning::kOn) continue;
      marks[j] |= Thinning::kQueued;
      queue.push_back(j);
    }
  }
  std::erase_if(thinning.remain, [&](std::uint32_t i) { return marks[i] == 0; });
}

}  // namespace topo::places
