// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/grid/occupancy_grid.hpp"
#include "tests/sim/raster.hpp"

namespace topo::bench {

/// How much of what can be seen of the building a robot's map knows. Takes the map as it changes; costs the
/// tiles that changed. Must go before the map's arena.
class Coverage {
 public:
  /// `visible`: cells that are not 0 count. `T_building_map`: the robot's true start.
  Coverage(const sim::Raster& visible, const types::Se2& T_building_map, double resolution_m);

  void update(const grid::OccupancyGrid& grid);

  /// Known as free, of all that count.
  [[nodiscard]] double free_fraction() const { return fraction(free_); }
  /// Known at all: the rest is mostly the rim of walls.
  [[nodiscard]] double known_fraction() const { return fraction(known_); }
  /// 1 where a cell that counts is known as free, for pictures.
  [[nodiscard]] const sim::Raster& covered() const { return covered_; }

 private:
  struct Wanted {
    patricia::Key tile;
    std::uint16_t in_tile;
    std::uint32_t cell;
  };
  void recount(patricia::Key tile, const grid::Tile& content);
  [[nodiscard]] double fraction(std::size_t cells) const;

  sim::Raster covered_;
  std::vector<Wanted> wanted_;           ///< by tile
  std::vector<grid::CellState> states_;  ///< of each wanted cell
  std::size_t free_ = 0, known_ = 0;
  grid::OccupancyGrid::Tiles last_;
};

}  // namespace topo::bench
