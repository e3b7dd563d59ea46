// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/piece_runs.hpp"

#include <algorithm>
#include <bit>

#include "core/grid/free_runs.hpp"

namespace topo::places {
namespace {

/// Non-negative floats have the order of their bits, and the compiler vectorises the maximum of integers.
float greatest(std::span<const float> values) {
  std::int32_t most = 0;
  for (const float& value : values) most = std::max(most, std::bit_cast<std::int32_t>(value));
  return std::bit_cast<float>(most);
}

/// Appends the runs of [from, end); no run may begin before or end after it.
void scan(std::size_t from, std::size_t end, std::span<const float> clearance_m,
          std::span<const std::uint32_t> labels, std::vector<PieceRun>& runs) {
  for (std::size_t i = from; i < end;) {
    const std::size_t first = i;
    const std::uint32_t label = labels[i];
    while (i < end && labels[i] == label) ++i;
    if (label == 0) continue;
    runs.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(i), label,
                    greatest(clearance_m.subspan(first, i - first))});
  }
}

}  // namespace

std::vector<PieceRun> piece_runs(const grid::DenseMap& map, std::span<const float> clearance_m,
                                 std::span<const std::uint32_t> labels) {
  std::vector<PieceRun> runs;
  grid::for_each_free_run(
      map, [&](const grid::FreeRun& free) { scan(free.first, free.end, clearance_m, labels, runs); });
  return runs;
}

}  // namespace topo::places
