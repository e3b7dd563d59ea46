// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/occupancy_grid.hpp"

namespace topo::grid {

/// Draws what one keyframe saw into a grid: each cell counts at most once a keyframe, as hit if any ray ended
/// in it, as miss if rays only passed. Drawing with the opposite sign takes the same evidence back exactly.
/// Keeps a scratch buffer; one thread.
class ScanRasteriser {
 public:
  enum class Sign { kAdd, kRemove };

  /// `sensor` and `hits` in base_link, metres; rays run from the sensor to each hit. `T_map_base` is the
  /// keyframe's pose. Rays end at hits at most `range_max_m` away.
  void draw(OccupancyGrid& grid, const types::Se2& T_map_base, const Eigen::Vector2f& sensor,
            std::span<const Eigen::Vector2f> hits, Sign sign);

 private:
  enum Mark : std::uint8_t { kNothing, kMiss, kHit };
  void prepare(const OccupancyGrid& grid, const types::Se2& T_map_base, const Eigen::Vector2f& sensor,
               std::span<const Eigen::Vector2f> hits);
  void trace(CellIndex to);
  void apply(OccupancyGrid& grid, Sign sign) const;
  [[nodiscard]] std::size_t at(CellIndex cell) const {
    return static_cast<std::size_t>(cell.y - box_.min.y) * width_ +
           static_cast<std::size_t>(cell.x - box_.min.x);
  }

  CellBox box_;  ///< whole tiles
  std::size_t width_ = 0;
  CellIndex from_;
  std::vector<CellIndex> ends_;
  std::vector<std::uint8_t> marks_;
};

}  // namespace topo::grid
