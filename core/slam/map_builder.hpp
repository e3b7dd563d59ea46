// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/grid/scan_rasteriser.hpp"
#include "core/slam/keyframe.hpp"
#include "core/walls/wall_store.hpp"

namespace topo::slam {

/// Draws keyframes into the grid and the wall store, and again where they moved. The result is a function of
/// the keyframes and the poses they were drawn at. Belongs to the thread that made it, or that called
/// adopt().
class MapBuilder {
 public:
  explicit MapBuilder(const GridParams& params);

  /// Makes the calling thread the owner of all nodes.
  void adopt();

  /// Brings the map up to date. Costs the keyframes that are new or moved more than the parameters say; walls
  /// are drawn again as a whole when any moved, because what was ORed cannot be taken back.
  void update(std::span<const KeyframePtr> keyframes, std::span<const types::Se2> poses);

  [[nodiscard]] const grid::OccupancyGrid& grid() const { return grid_; }
  [[nodiscard]] const walls::WallStore& walls() const { return walls_; }

 private:
  void draw_columns(const Keyframe& keyframe, const types::Se2& pose);

  GridParams params_;
  patricia::Arena<grid::TileRef> tile_arena_;
  patricia::Arena<walls::Slabs> column_arena_;
  grid::OccupancyGrid grid_;
  walls::WallStore walls_;
  grid::ScanRasteriser rasteriser_;
  std::vector<types::Se2> drawn_;
};

}  // namespace topo::slam
