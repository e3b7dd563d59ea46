// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/piece_runs.hpp"

#include "core/grid/free_runs.hpp"

namespace topo::places {

std::vector<PieceRun> piece_runs(const grid::DenseMap& map, const FirstLabels& first) {
  std::vector<PieceRun> runs;
  const PieceNumbers numbers(first, map.cells.size());
  const std::uint32_t* const labels = first.labels.data();
  grid::for_each_free_run(map, [&](const grid::FreeRun& free) {
    for (std::size_t i = free.first; i < free.end;) {
      const std::size_t begin = i;
      const std::uint32_t label = labels[i];
      while (i < free.end && labels[i] == label) ++i;
      if (label == 0) continue;
      runs.push_back({static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(i), numbers.of(label)});
    }
  });
  return runs;
}

}  // namespace topo::places
