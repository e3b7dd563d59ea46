// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/furniture.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "core/grid/free_runs.hpp"

namespace topo::places {
namespace {

using grid::CellState;
using grid::DenseMap;

/// Cells side by side that are not free.
struct Run {
  std::int32_t row, first, end;
  std::uint32_t parent;  ///< run of the same island
};

/// What the runs of one island span.
struct Extent {
  std::int32_t left, right, low, high;
};

/// Islands of what is not free, by joining runs of neighbouring rows.
class Islands {
 public:
  explicit Islands(const DenseMap& map) : map_(map) {
    std::uint32_t before = 0;
    for (std::int32_t row = 0; row < map.height(); ++row) {
      const auto here = static_cast<std::uint32_t>(runs_.size());
      add_row(row);
      join_rows(before, here);
      before = here;
    }
    measure();
  }

  /// Calls visit(run) for the runs of the islands that are no longer than `side` cells and touch no border.
  template <class Visit>
  void for_each_small(std::int32_t side, Visit&& visit) {
    for (std::uint32_t r = 0; r < runs_.size(); ++r) {
      const Extent& e = extents_[find(r)];
      const bool inside = e.left > 0 && e.low > 0 && e.right < map_.width() && e.high + 1 < map_.height();
      if (inside && e.right - e.left <= side && e.high - e.low < side) visit(runs_[r]);
    }
  }

 private:
  void add_row(std::int32_t row) {
    const auto width = static_cast<std::size_t>(map_.width());
    const CellState* const cells = map_.cells.data() + static_cast<std::size_t>(row) * width;
    for (std::size_t x = 0; (x = grid::end_of_free({cells, width}, x, width)) < width;) {
      const std::size_t first = x;
      const void* free = std::memchr(cells + x, static_cast<int>(CellState::kFree), width - x);
      x = free == nullptr ? width : static_cast<std::size_t>(static_cast<const CellState*>(free) - cells);
      runs_.push_back({row, static_cast<std::int32_t>(first), static_cast<std::int32_t>(x),
                       static_cast<std::uint32_t>(runs_.size())});
    }
  }
  /// Runs [a, b) of one row and [b, end) of the next touch over sides or corners.
  void join_rows(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t middle = b, end = static_cast<std::uint32_t>(runs_.size());
    while (a < middle && b < end) {
      if (runs_[a].end >= runs_[b].first && runs_[b].end >= runs_[a].first) join(a, b);
      (runs_[a].end < runs_[b].end ? a : b) += 1;
    }
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    runs_[std::max(a, b)].parent = std::min(a, b);
  }
  std::uint32_t find(std::uint32_t r) {
    while (runs_[r].parent != r) r = runs_[r].parent = runs_[runs_[r].parent].parent;
    return r;
  }
  void measure() {
    extents_.reserve(runs_.size());
    for (std::uint32_t r = 0; r < runs_.size(); ++r) {
      const Run& run = runs_[r];
      extents_.push_back({run.first, run.end, run.row, run.row});
      Extent& e = extents_[find(r)];
      e = {std::min(e.left, run.first), std::max(e.right, run.end), std::min(e.low, run.row),
           std::max(e.high, run.row)};
    }
  }

  const DenseMap& map_;
  std::vector<Run> runs_;
  std::vector<Extent> extents_;  ///< of the islands, at the number of their first run
};

/// Puts back what there is within a cell of the wall.
void restore_along(const types::Segment& wall, const DenseMap& map, DenseMap& open) {
  const double length_m = wall.length_m();
  if (!(length_m > 0.0) || !std::isfinite(length_m)) return;
  const types::Vector2 along = (wall.b - wall.a) / length_m;
  const std::size_t width = static_cast<std::size_t>(map.width());
  for (double d = 0.0; d <= length_m; d += map.resolution_m) {
    const grid::CellIndex middle = map.cell_at(wall.a + d * along);
    if (!map.contains(middle) || map.is_on_border(middle)) continue;  // beside it nothing stands free
    const std::size_t i = map.index(middle);
    for (const std::size_t row : {i - width, i, i + width})
      std::copy_n(&map.cells[row - 1], 3, &open.cells[row - 1]);
  }
}

}  // namespace

DenseMap without_furniture(const DenseMap& map, std::span<const types::Segment> walls, double furniture_m) {
  DenseMap open = map;
  const auto side = static_cast<std::int32_t>(std::lround(furniture_m / map.resolution_m));
  Islands(map).for_each_small(side, [&](const Run& run) {
    const auto row = open.cells.begin() + static_cast<std::ptrdiff_t>(run.row) * open.width();
    std::fill(row + run.first, row + run.end, CellState::kFree);
  });
  for (const types::Segment& wall : walls) restore_along(wall, map, open);
  return open;
}

}  // namespace topo::places
