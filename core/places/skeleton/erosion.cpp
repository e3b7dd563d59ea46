// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/skeleton/erosion.hpp"

#include "core/places/skeleton/first_states.hpp"
#include "core/places/skeleton/settling.hpp"
#include "core/places/skeleton/sparse_scan.hpp"
#include "core/places/skeleton/thinning_state.hpp"

namespace topo::places {
namespace {

using grid::DenseMap;

/// Kept cells in the order of their turns, within a turn by number.
std::vector<std::uint32_t> kept_in_order(std::span<const ThinningState> states) {
  std::vector<std::uint32_t> cells, ends((kBuckets << 1U) + 1, 0);
  const auto turn = [&](std::uint32_t i) { return static_cast<std::size_t>(states[i] >> kTurnShift); };
  for_each_with(Erosion::kKept, states,
                [&](std::size_t i) { cells.push_back(static_cast<std::uint32_t>(i)); });
  for (const std::uint32_t cell : cells) ++ends[turn(cell) + 1];
  for (std::size_t t = 0; t + 1 < ends.size(); ++t) ends[t + 1] += ends[t];
  std::vector<std::uint32_t> kept(cells.size());
  // Each entry begins as the start of its turn, and becomes its end.
  for (const std::uint32_t cell : cells) kept[ends[turn(cell)]++] = cell;
  return kept;
}

}  // namespace

std::array<std::ptrdiff_t, 8> neighbour_offsets(const DenseMap& map) {
  const std::ptrdiff_t up = map.width();
  return {1, up + 1, up, up - 1, -1, -up - 1, -up, -up + 1};
}

Erosion erode(const DenseMap& map, std::span<const float> clearance_m) {
  Erosion erosion{map.box, std::vector<ThinningState>(map.cells.size(), 0), {}};
  if (map.cells.empty()) return erosion;
  Settling settling(map, erosion.states);
  for (const std::uint32_t i : assume_states(map, clearance_m, erosion.states)) settling.doubt(i);
  settling.settle_all();
  erosion.kept = kept_in_order(erosion.states);
  return erosion;
}

}  // namespace topo::places
