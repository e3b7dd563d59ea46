// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/grid/cell.hpp"
#include "core/grid/tile.hpp"
#include "core/patricia/map.hpp"
#include "core/types/geometry.hpp"

namespace topo::grid {

/// Unbounded occupancy grid: tiles in a persistent Patricia tree. A copy is a snapshot in O(1) and does not
/// change with the original. Reading is safe on any thread while the copy is alive; changing, copying and
/// destroying belong to the thread that owns the arena.
class OccupancyGrid {
 public:
  using Tiles = patricia::Map<TileRef>;

  OccupancyGrid(patricia::Arena<TileRef>& arena, double resolution_m);

  [[nodiscard]] double resolution_m() const { return resolution_m_; }
  [[nodiscard]] CellIndex cell_at(const types::Vector2& p_map) const {
    return {static_cast<std::int32_t>(std::floor(p_map.x() / resolution_m_)),
            static_cast<std::int32_t>(std::floor(p_map.y() / resolution_m_))};
  }
  [[nodiscard]] types::Vector2 centre_of(CellIndex cell) const {
    return {(cell.x + 0.5) * resolution_m_, (cell.y + 0.5) * resolution_m_};
  }

  /// Evidence of one cell; zero where nothing was observed.
  [[nodiscard]] CellCounts counts(CellIndex cell) const;
  [[nodiscard]] CellState state(CellIndex cell) const { return state_of(counts(cell)); }

  /// Returns the tile with the given tile index (cell index divided by Tile::kSide, rounded down) for
  /// modification.
  [[nodiscard]] Tile& tile_to_change(std::int32_t tile_x, std::int32_t tile_y) {
    return tiles_.update(patricia::cell_key(tile_x, tile_y)).write();
  }
  void clear() { tiles_.clear(); }
  [[nodiscard]] const Tiles& tiles() const { return tiles_; }

  /// Smallest box around all cells that are not unknown. Costs one pass over the tiles.
  [[nodiscard]] CellBox known_box() const;

  /// Calls f(CellIndex, CellState) for every cell that is not unknown, tile by tile.
  template <class F>
  void for_each_known(F&& f) const {
    tiles_.for_each([&](patricia::Key key, const TileRef& tile) {
      const auto corner = patricia::cell_of(key);
      for (int y = 0; y < Tile::kSide; ++y) {
        for (int x = 0; x < Tile::kSide; ++x) {
          const CellState state = state_of(tile.read().cells[Tile::index(x, y)]);
          if (state != CellState::kUnknown)
            f(CellIndex{corner.x * Tile::kSide + x, corner.y * Tile::kSide + y}, state);
        }
      }
    });
  }

 private:
  Tiles tiles_;
  double resolution_m_;
};

/// Number of cells whose state differs between two versions of a grid. Linear in the tiles that they do not
/// share. Any thread.
std::size_t differing_cells(const OccupancyGrid& one, const OccupancyGrid& other);

}  // namespace topo::grid
