// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/travel/islands.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/grid/joined_runs.hpp"

namespace topo::travel {
namespace {

grid::JoinedRuns occupied_runs(const grid::DenseMap& map) {
  grid::JoinedRuns runs;
  const auto width = static_cast<std::size_t>(map.width());
  runs.clear(width);
  for (std::size_t row = 0; row < map.cells.size(); row += width) {
    const std::size_t end = row + width;
    for (std::size_t i = row; i < end;) {
      const void* const found =
          std::memchr(&map.cells[i], static_cast<int>(grid::CellState::kOccupied), end - i);
      if (found == nullptr) break;
      const auto first =
          static_cast<std::size_t>(static_cast<const grid::CellState*>(found) - map.cells.data());
      for (i = first; i < end && map.cells[i] == grid::CellState::kOccupied;) ++i;
      runs.add({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(i)});
    }
  }
  return runs;
}

/// Sets the unknown cells within `side` cells of a piece to free.
void open_around(const grid::JoinedRuns::Extent& piece, std::uint32_t side, grid::DenseMap& map) {
  const auto width = static_cast<std::uint32_t>(map.width()),
             height = static_cast<std::uint32_t>(map.height());
  const auto before = [side](std::uint32_t at) { return at > side ? at - side : 1U; };  // not the border
  for (std::uint32_t y = before(piece.low); y < std::min(piece.high + side + 1, height - 1); ++y) {
    for (std::uint32_t x = before(piece.left); x < std::min(piece.right + side, width - 1); ++x) {
      grid::CellState& cell = map.cells[std::size_t{y} * width + x];
      if (cell == grid::CellState::kUnknown) cell = grid::CellState::kFree;
    }
  }
}

}  // namespace

grid::DenseMap without_islands(const grid::DenseMap& map, double side_m) {
  grid::DenseMap open = map;
  const auto side = static_cast<std::uint32_t>(std::lround(side_m / map.resolution_m));
  grid::JoinedRuns runs = occupied_runs(map);
  const std::vector<grid::JoinedRuns::Extent> extents = runs.extents();
  for (std::uint32_t r = 0; r < runs.size(); ++r) {
    const grid::JoinedRuns::Extent& piece = extents[runs.root_of(r)];
    if (piece.right - piece.left > side || piece.high - piece.low >= side) continue;
    std::fill(open.cells.begin() + runs[r].first, open.cells.begin() + runs[r].end, grid::CellState::kFree);
    if (runs.root_of(r) == r) open_around(piece, side, open);
  }
  return open;
}

}  // namespace topo::travel
