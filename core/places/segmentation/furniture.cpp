// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/furniture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#include "core/grid/cell_block.hpp"
#include "core/grid/free_runs.hpp"
#include "core/grid/other_blocks.hpp"

namespace topo::places {
namespace {

using grid::CellState;
using grid::DenseMap;

using Extent = grid::JoinedRuns::Extent;

/// Islands of cells that are not free, within a part of a map.
class Islands {
 public:
  Islands(const DenseMap& map, const Extent& part)
      : width_(static_cast<std::size_t>(map.width())), height_(static_cast<std::size_t>(map.height())) {
    runs_.clear(width_);
    for (std::size_t y = part.low; y <= part.high; ++y)
      add_row(map.cells, y * width_ + part.left, y * width_ + part.right);
    extents_ = runs_.extents();
  }

  /// Calls visit(run, extent) for the runs of islands that are at most `side` cells long and touch no border
  /// of the map.
  template <class Visit>
  void for_each_small(std::size_t side, Visit&& visit) {
    for (std::uint32_t r = 0; r < runs_.size(); ++r) {
      const Extent& e = extents_[runs_.root_of(r)];
      const bool inside = e.left > 0 && e.low > 0 && e.right < width_ && e.high + 1 < height_;
      if (inside && e.right - e.left <= side && e.high - e.low < side) visit(runs_[r], e);
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
  std::vector<Extent> extents_;
};

constexpr Extent kNothing{UINT32_MAX, 0, UINT32_MAX, 0};

/// Grows an extent by this many cells to each side, within the map.
Extent grown(const Extent& e, std::size_t by, const DenseMap& map) {
  const auto cells = static_cast<std::uint32_t>(by), width = static_cast<std::uint32_t>(map.width()),
             height = static_cast<std::uint32_t>(map.height());
  return {e.left - std::min(e.left, cells), std::min(e.right + cells, width), e.low - std::min(e.low, cells),
          std::min(e.high + cells, height - 1)};
}

bool overlap(const Extent& a, const Extent& b) {
  return a.left < b.right && b.left < a.right && a.low <= b.high && b.low <= a.high;
}

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

/// Restores the cleared cells of the map taken last.
void FurnitureUpdate::put_back() {
  auto from = hidden_.begin();
  for (const Piece& piece : pieces_) {
    const auto end = from + (piece.run.end - piece.run.first);
    std::copy(from, end, open_.cells.begin() + piece.run.first);
    from = end;
  }
}

/// Copies the map's cells; returns the extent of the changed ones.
FurnitureUpdate::Extent FurnitureUpdate::renew_cells(const DenseMap& map) {
  const auto width = static_cast<std::uint32_t>(map.width()),
             height = static_cast<std::uint32_t>(map.height());
  if (open_.box != map.box || open_.resolution_m != map.resolution_m) {
    open_ = map;
    pieces_.clear();
    others_.add({0, static_cast<std::uint32_t>(map.cells.size())});
    return {0, width, 0, height - 1};
  }
  Extent others = kNothing;
  const auto take = [&](std::size_t y, std::size_t x, std::size_t count) {
    const auto row = static_cast<std::uint32_t>(y), from = static_cast<std::uint32_t>(x);
    others = {std::min(others.left, from), std::max(others.right, from + static_cast<std::uint32_t>(count)),
              std::min(others.low, row), row};
    const std::size_t at = y * width + x;
    others_.add({static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(at + count)});
    std::copy_n(&map.cells[at], count, &open_.cells[at]);
  };
  grid::for_each_other_block(map.cells, open_.cells, width, grid::kCellBlock, take);
  return others;
}

/// Marks the pieces as changed: walls restore some of their cells.
void FurnitureUpdate::note_pieces() {
  for (const Piece& piece : pieces_) others_.add(piece.run);
}

/// A piece whose extent does not touch the grown change is unchanged. Every other piece is no farther from
/// the change than its own length.
void FurnitureUpdate::find_pieces(const Extent& changed) {
  if (changed.left >= changed.right) return;
  const Extent beside = grown(changed, 1, open_);
  std::erase_if(pieces_, [&](const Piece& piece) { return overlap(piece.whole, beside); });
  Islands(open_, grown(changed, side_ + 1, open_))
      .for_each_small(side_, [&](const grid::CellRun& run, const Extent& whole) {
        if (overlap(whole, beside)) pieces_.push_back({run, whole});
      });
}

void FurnitureUpdate::clear_away() {
  hidden_.clear();
  for (const Piece& piece : pieces_) {
    const auto begin = open_.cells.begin() + piece.run.first, end = open_.cells.begin() + piece.run.end;
    hidden_.insert(hidden_.end(), begin, end);
    std::fill(begin, end, CellState::kFree);
  }
}

grid::Rows FurnitureUpdate::take(const DenseMap& map, double furniture_m) {
  const auto side = static_cast<std::size_t>(std::lround(furniture_m / map.resolution_m));
  if (std::exchange(side_, side) != side) open_ = {};
  if (!open_.cells.empty()) put_back();
  others_ = grid::CellBlocks(map.cells.size());
  if (map.cells.empty()) {
    open_ = map;
    pieces_.clear();
    hidden_.clear();
    return {};
  }
  if (open_.box == map.box) note_pieces();
  const Extent others = renew_cells(map);
  find_pieces(others);
  note_pieces();
  clear_away();
  if (others.left >= others.right) return {};
  return {others.low, std::size_t{others.high} + 1};
}

const DenseMap& FurnitureUpdate::clear(const DenseMap& map, std::span<const types::Segment> walls) {
  for (const types::Segment& wall : walls) restore_along(wall, map, open_);
  return open_;
}

DenseMap without_furniture(const DenseMap& map, std::span<const types::Segment> walls, double furniture_m) {
  FurnitureUpdate update;
  update.take(map, furniture_m);
  update.clear(map, walls);
  return std::move(update).release();
}

}  // namespace topo::places
