// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/grid/occupancy_grid.hpp"

namespace topo::grid {
namespace {

/// Division by the tile's side, rounded towards minus infinity.
constexpr std::int32_t tile_of(std::int32_t cell) { return cell >> 5; }
static_assert(Tile::kSide == 1 << 5);

/// Null: a tile of unknown cells.
std::size_t differing_cells(const TileRef* one, const TileRef* other) {
  static constexpr Tile kUnknown;
  const Tile& a = one != nullptr ? one->read() : kUnknown;
  const Tile& b = other != nullptr ? other->read() : kUnknown;
  std::size_t differing = 0;
  for (std::size_t i = 0; i < a.cells.size(); ++i)
    differing += state_of(a.cells[i]) != state_of(b.cells[i]) ? 1U : 0U;
  return differing;
}

}  // namespace

OccupancyGrid::OccupancyGrid(patricia::Arena<TileRef>& arena, double resolution_m)
    : tiles_(arena), resolution_m_(resolution_m) {}

CellCounts OccupancyGrid::counts(CellIndex cell) const {
  const std::int32_t tx = tile_of(cell.x), ty = tile_of(cell.y);
  const TileRef* tile = tiles_.find(patricia::cell_key(tx, ty));
  if (tile == nullptr) return {};
  return tile->read().cells[Tile::index(cell.x - tx * Tile::kSide, cell.y - ty * Tile::kSide)];
}

CellBox OccupancyGrid::known_box() const {
  CellBox box;
  for_each_known([&](CellIndex cell, CellState) { box.extend(cell); });
  return box;
}

std::size_t differing_cells(const OccupancyGrid& one, const OccupancyGrid& other) {
  std::size_t differing = 0;
  OccupancyGrid::Tiles::difference(
      one.tiles(), other.tiles(),
      [&](patricia::Key, const TileRef* a, const TileRef* b) { differing += differing_cells(a, b); });
  return differing;
}

}  // namespace topo::grid
