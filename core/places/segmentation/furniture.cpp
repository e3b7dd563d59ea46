// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/furniture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "core/grid/free_runs.hpp"
#include "core/grid/joined_runs.hpp"

namespace topo::places {
namespace {

using grid::CellState;
using grid::DenseMap;

/// Islands of cells that are not free.
class Islands {
 public:
  explicit Islands(const DenseMap& map)
      : width_(static_cast<std::size_t>(map.width())), height_(static_cast<std::size_t>(map.height())) {
    runs_.clear(width_);
    for (std::size_t y = 0; y < height_; ++y) add_row(map.cells, y * width_, (y + 1) * width_);
    extents_ = runs_.extents();
  }

  /// Calls visit(run) for the runs of islands that are at most `side` cells long and touch no border
  /// of the map.
  template <class Visit>
  void for_each_small(std::size_t side, Visit&& visit) {
    for (std::uint32_t r = 0; r < runs_.size(); ++r) {
      const grid::JoinedRuns::Extent& e = extents_[runs_.root_of(r)];
      const bool inside = e.left > 0 && e.low > 0 && e.right < width_ && e.high + 1 < height_;
      if (inside && e.right - e.left <= side && e.high - e.low < side) visit(runs_[r]);
    }
  }

 private:
  void add_row(std::span<const CellState> cells, std::size_t from, std::size_t end) {
    for (std::size_t i = from; (i = grid::end_of_free(cells, i, end)) < end;) {
      const std::size_t first = i;
      const void* free = std::memchr(&cells[i], static_cast<int>(CellState::kFree), end - i);
      i = free == nullptr ? end
                          : static_cast<std::size_t>(static_cast<const CellState*>(free) - cells.data());
      runs_.add({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(i)});
    }
  }
  std::size_t width_, height_;
  grid::JoinedRuns runs_;
  std::vector<grid::JoinedRuns::Extent> extents_;
};

/// Restores the map's cells within one cell of the wall.
void restore_along(const types::Segment& wall, const DenseMap& map, DenseMap& open) {
  const double length_m = wall.length_m();
  if (!(length_m > 0.0) || !std::isfinite(length_m)) return;
  const types::Vector2 along = (wall.b - wall.a) / length_m;
  const std::size_t width = static_cast<std::size_t>(map.width());
  for (double d = 0.0; d <= length_m; d += map.resolution_m) {
    const grid::CellIndex middle = map.cell_at(wall.a + d * along);
    if (!map.contains(middle) || map.is_on_border(middle)) continue;  // no furniture beside the border
    const std::size_t i = map.index(middle);
    for (const std::size_t row : {i - width, i, i + width})
      std::memcpy(&open.cells[row - 1], &map.cells[row - 1],
                  3 * sizeof(CellState));  // no function call, unlike copy_n
  }
}

}  // namespace

DenseMap without_furniture(const DenseMap& map, std::span<const types::Segment> walls, double furniture_m) {
  DenseMap open = map;
  if (map.cells.empty()) return open;
  const auto side = static_cast<std::size_t>(std::lround(furniture_m / map.resolution_m));
  Islands(map).for_each_small(side, [&](const grid::CellRun& run) {
    std::fill(open.cells.begin() + run.first, open.cells.begin() + run.end, CellState::kFree);
  });
  for (const types::Segment& wall : walls) restore_along(wall, map, open);
  return open;
}

}  // namespace topo::places
