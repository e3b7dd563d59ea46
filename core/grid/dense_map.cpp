// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/grid/dense_map.hpp"

#include <algorithm>
#include <span>

#include "core/grid/occupancy_grid.hpp"

namespace topo::grid {
namespace {

struct PlacedTile {
  CellIndex corner;
  const Tile* tile;
};

std::vector<PlacedTile> placed_tiles(const OccupancyGrid& grid) {
  std::vector<PlacedTile> tiles;
  tiles.reserve(grid.tiles().size());
  grid.tiles().for_each([&](patricia::Key key, const TileRef& tile) {
    const auto at = patricia::cell_of(key);
    tiles.push_back({{at.x * Tile::kSide, at.y * Tile::kSide}, &tile.read()});
  });
  return tiles;
}

/// Branch-free state_of, so that a row of a tile is a few vector instructions.
CellState branchless_state(const CellCounts& counts) {
  const unsigned hits = counts.hits, misses = counts.misses;
  const unsigned known = (hits | misses) != 0U ? 1U : 0U;
  const unsigned occupied = 3U * hits >= misses ? 1U : 0U;
  return static_cast<CellState>(known + (known & occupied));
}
static_assert(static_cast<int>(CellState::kUnknown) == 0 && static_cast<int>(CellState::kFree) == 1 &&
              static_cast<int>(CellState::kOccupied) == 2);

bool known(const CellCounts& counts) { return (counts.hits | counts.misses) != 0; }

/// Extends the box by the tile's known cells.
void extend(CellBox& box, const PlacedTile& placed) {
  for (int y = 0; y < Tile::kSide; ++y) {
    const std::span row(&placed.tile->cells[Tile::index(0, y)], Tile::kSide);
    const auto first = std::find_if(row.begin(), row.end(), known);
    if (first == row.end()) continue;
    const auto last = std::find_if(row.rbegin(), row.rend(), known);
    const int cell_y = placed.corner.y + y;
    box.extend({placed.corner.x + static_cast<int>(first - row.begin()), cell_y});
    box.extend({placed.corner.x + Tile::kSide - 1 - static_cast<int>(last - row.rbegin()), cell_y});
  }
}

/// Tiles inside the current box cannot extend it; in the tree's order, most tiles are skipped.
CellBox known_box(std::span<const PlacedTile> tiles) {
  CellBox box;
  for (const PlacedTile& placed : tiles) {
    const CellIndex min = placed.corner;
    const CellIndex max{min.x + Tile::kSide - 1, min.y + Tile::kSide - 1};
    if (min.x >= box.min.x && max.x <= box.max.x && min.y >= box.min.y && max.y <= box.max.y) continue;
    extend(box, placed);
  }
  return box;
}

/// Copies the part of a tile that lies in the map; it contains all known cells.
void copy_tile(const PlacedTile& placed, DenseMap& map) {
  const int x0 = std::max(placed.corner.x, map.box.min.x);
  const int x1 = std::min(placed.corner.x + Tile::kSide - 1, map.box.max.x);
  const int y0 = std::max(placed.corner.y, map.box.min.y);
  const int y1 = std::min(placed.corner.y + Tile::kSide - 1, map.box.max.y);
  if (x0 > x1) return;
  for (int y = y0; y <= y1; ++y) {
    const CellCounts* from = &placed.tile->cells[Tile::index(x0 - placed.corner.x, y - placed.corner.y)];
    CellState* to = &map.cells[map.index({x0, y})];
    for (int x = 0; x <= x1 - x0; ++x) to[x] = branchless_state(from[x]);
  }
}

}  // namespace

DenseMap dense_map(const OccupancyGrid& grid, int margin) {
  DenseMap map;
  map.resolution_m = grid.resolution_m();
  const std::vector<PlacedTile> tiles = placed_tiles(grid);
  const CellBox known = known_box(tiles);
  if (known.empty()) return map;
  const int border = std::max(margin, 1);
  map.box.min = {known.min.x - border, known.min.y - border};
  map.box.max = {known.max.x + border, known.max.y + border};
  map.cells.assign(static_cast<std::size_t>(map.width()) * static_cast<std::size_t>(map.height()),
                   CellState::kUnknown);
  for (const PlacedTile& placed : tiles) copy_tile(placed, map);
  return map;
}

}  // namespace topo::grid
