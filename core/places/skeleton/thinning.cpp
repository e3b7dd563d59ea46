// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/skeleton/thinning.hpp"

#include <algorithm>

#include "core/places/skeleton/fetch_ahead.hpp"
#include "core/places/skeleton/simple_cell.hpp"

namespace topo::places {
using grid::DenseMap;

Thinning thin_to_ridge(const DenseMap& map, const Erosion& erosion) {
  Thinning thinning{std::vector<std::uint8_t>(map.cells.size(), 0), erosion.kept};
  for (std::size_t k = 0; k < erosion.kept.size(); ++k) {
    const std::uint32_t i = erosion.kept[k];
    fetch_ahead(erosion.states.data(), erosion.kept, k);
    fetch_ahead(thinning.marks.data(), erosion.kept, k);
    const bool ridge = (erosion.states[i] & Erosion::kRidge) != 0;
    thinning.marks[i] =
        Thinning::kOn | Thinning::kDoubted | Thinning::kAhead | (ridge ? Thinning::kRidge : 0);
  }
  return thinning;
}

void thin_to_lines(const DenseMap& map, Thinning& thinning) {
  auto& marks = thinning.marks;
  const auto offsets = neighbour_offsets(map);
  // A cell that must stay now may become removable when a neighbour is removed. So each removal puts its
  // neighbours in doubt again: they wait for their turn if that is still to come, else they are queued.
  std::vector<std::uint32_t> again;
  const auto look_at = [&](std::uint32_t i) {
    marks[i] &= static_cast<std::uint8_t>(~Thinning::kDoubted);
    const unsigned pattern = thinning.pattern_at(i, offsets);
    const bool end = (marks[i] & Thinning::kRidge) != 0 && (pattern & (pattern - 1)) == 0;
    if (end || !is_simple(pattern)) return;
    thinning.take_away(i, offsets, [&](std::uint32_t j) {
      if ((marks[j] & Thinning::kAhead) == 0) again.push_back(j);
    });
  };
  for (const std::uint32_t i : thinning.remain) {
    marks[i] &= static_cast<std::uint8_t>(~Thinning::kAhead);
    if ((marks[i] & Thinning::kDoubted) != 0) look_at(i);
  }
  for (std::size_t next = 0; next < again.size(); ++next) look_at(again[next]);
  std::erase_if(thinning.remain, [&](std::uint32_t i) {
    if (marks[i] == 0) return true;
    marks[i] |= Thinning::kAhead;  // for the next call
    return false;
  });
}

}  // namespace topo::places
