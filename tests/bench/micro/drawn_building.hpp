// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>

#include "core/grid/occupancy_grid.hpp"

namespace topo::bench {

using grid::CellIndex;
using grid::CellState;

/// A grid drawn by hand: corridors in a ring with rooms along them, doors, clutter, and rooms not seen yet.
class Building {
 public:
  /// `scale` times as many corridors to each side: known cells grow with its square.
  explicit Building(int scale) : grid_(arena_, 0.05) {
    // The map's corners are known, so that it has the paper's size whatever is drawn.
    set({0, 0}, CellState::kOccupied);
    set({kWidth * scale - 3, kHeight * scale - 3}, CellState::kOccupied);
    for (int block_y = 0; block_y < scale; ++block_y)
      for (int block_x = 0; block_x < scale; ++block_x) draw_block({block_x * kWidth, block_y * kHeight});
  }

  [[nodiscard]] const grid::OccupancyGrid& grid() const { return grid_; }

  static constexpr int kWidth = 1400;
  static constexpr int kHeight = 900;
  static constexpr CellIndex kInCorridor{220, 120};

 private:
  void set(CellIndex c, CellState state) {
    const int tx = c.x >> 5, ty = c.y >> 5;
    grid::CellCounts& cell =
        grid_.tile_to_change(tx, ty).cells[grid::Tile::index(c.x - tx * 32, c.y - ty * 32)];
    cell = state == CellState::kOccupied ? grid::CellCounts{3, 1} : grid::CellCounts{0, 4};
  }

  /// Free inside, walls two cells thick around.
  void draw_room(CellIndex min, CellIndex max) {
    for (int y = min.y; y <= max.y; ++y) {
      for (int x = min.x; x <= max.x; ++x) {
        const bool wall = x < min.x + 2 || x > max.x - 2 || y < min.y + 2 || y > max.y - 2;
        set({x, y}, wall ? CellState::kOccupied : CellState::kFree);
      }
    }
  }

  void free_rectangle(CellIndex min, CellIndex max) {
    for (int y = min.y; y <= max.y; ++y)
      for (int x = min.x; x <= max.x; ++x) set({x, y}, CellState::kFree);
  }

  void clutter(CellIndex min, CellIndex max) {
    std::uniform_int_distribution<int> x(min.x + 4, max.x - 12), y(min.y + 4, max.y - 12), size(1, 8);
    for (int i = 0; i < (max.x - min.x) * (max.y - min.y) / 700; ++i) {
      const CellIndex at{x(random_), y(random_)};
      for (int dy = size(random_); dy >= 0; --dy)
        for (int dx = size(random_); dx >= 0; --dx) set({at.x + dx, at.y + dy}, CellState::kOccupied);
    }
  }

  /// A ring of corridor of 2.4 m, 50 m by 35 m, with rooms along its long sides; every seventh is unseen.
  void draw_block(CellIndex o) {
    for (int i = 0; i < 13; ++i) {
      for (const int y : {20, 750}) {
        if (++room_ % 7 == 0) continue;
        const CellIndex min{o.x + 180 + i * 80, o.y + y}, max{min.x + 81, min.y + 81};
        draw_room(min, max);
        clutter(min, max);
      }
    }
    const CellIndex min{o.x + 180, o.y + 100}, max{o.x + 1220, o.y + 750};
    draw_room({min.x, min.y}, {max.x, min.y + 50});
    draw_room({min.x, max.y - 50}, {max.x, max.y + 1});
    draw_room({min.x, min.y}, {min.x + 50, max.y});
    draw_room({max.x - 50, min.y}, {max.x, max.y});
    for (const int x : {min.x + 2, max.x - 48}) free_rectangle({x, min.y + 2}, {x + 46, max.y - 2});
    for (const int y : {min.y + 2, max.y - 48}) free_rectangle({min.x + 2, y}, {max.x - 2, y + 46});
    for (int i = 0; i < 13; ++i) {
      for (const int y : {98, 748})
        free_rectangle({o.x + 200 + i * 80, o.y + y}, {o.x + 219 + i * 80, o.y + y + 6});
    }
  }

  patricia::Arena<grid::TileRef> arena_;
  grid::OccupancyGrid grid_;
  std::mt19937 random_{1};
  int room_ = 0;
};

}  // namespace topo::bench
