// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/occupancy_grid.hpp"

namespace topo::grid {

/// Draws the rays of one keyframe into a grid. Each cell counts at most once per keyframe: as a hit when any
/// ray ends in it, as a miss when rays only pass through it. Keeps scratch buffers. Single-threaded.
class ScanRasteriser {
 public:
  /// `sensor` and `hits` in base_link, metres; rays run from the sensor to each hit. `T_map_base` is the
  /// keyframe's pose.
  void draw(OccupancyGrid& grid, const types::Se2& T_map_base, const Eigen::Vector2f& sensor,
            std::span<const Eigen::Vector2f> hits);

  /// Removes exactly what was drawn at `before` and draws it at `after`. Tiles with the same marks before and
  /// after are not touched, and so stay shared with other versions of the grid.
  void move(OccupancyGrid& grid, const types::Se2& before, const types::Se2& after,
            const Eigen::Vector2f& sensor, std::span<const Eigen::Vector2f> hits);

 private:
  enum Mark : std::uint8_t { kNothing, kMiss, kHit };

  /// One drawing: the cells where rays begin and end, and their marks within a box of cells.
  struct Sketch {
    CellIndex from;
    std::vector<CellIndex> ends;
    CellBox box;  ///< around the cells, whole tiles
    std::vector<std::uint8_t> marks;
  };
  static void outline(Sketch& sketch, const OccupancyGrid& grid, const types::Se2& T_map_base,
                      const Eigen::Vector2f& sensor, std::span<const Eigen::Vector2f> hits);
  static void fill(Sketch& sketch, const CellBox& box);
  static void apply(OccupancyGrid& grid, const CellBox& box, const Sketch* before, const Sketch* after);

  Sketch before_, after_;
};

}  // namespace topo::grid
