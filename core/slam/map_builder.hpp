// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/grid/occupancy_grid.hpp"
#include "core/grid/scan_rasteriser.hpp"
#include "core/slam/keyframe.hpp"
#include "core/slam/params.hpp"
#include "core/walls/column_ledger.hpp"

namespace topo::slam {

/// Draws keyframes into the grid and the wall store, and redraws those that moved. The result is a function
/// of the keyframes and the poses at which they were drawn. When many moved, the map at the new poses is
/// prepared piece by piece beside the shown one, so that no reader waits for it or sees it half done. Belongs
/// to the thread that created it or called adopt().
class MapBuilder {
 public:
  explicit MapBuilder(const GridParams& params);

  /// Makes the calling thread the owner of all nodes.
  void adopt();

  /// Draws the keyframes added since the last call into the shown map.
  void extend(std::span<const KeyframePtr> keyframes, std::span<const types::Se2> poses);

  /// Continues the map of these keyframes at these poses, and begins it when none is in preparation. Draws
  /// the keyframes that are new or moved more than the parameters allow, until they sum up to `beams_max`
  /// beams and columns, at least one. True when all are drawn. Until show(), the poses of keyframes from
  /// earlier calls must stay the same.
  bool prepare(std::span<const KeyframePtr> keyframes, std::span<const types::Se2> poses,
               std::size_t beams_max);

  /// Replaces the shown map by the map in preparation.
  void show();

  /// Makes the shown map exact: redraws keyframes whose pose differs from where they were drawn, until they
  /// sum up to `beams_max` beams and columns, at least one. True when none is left. Does nothing while a map
  /// is in preparation. `poses` are those of the map shown last and of its extensions.
  bool settle(std::span<const KeyframePtr> keyframes, std::span<const types::Se2> poses,
              std::size_t beams_max);

  /// Does all of it at once and exactly: shows the map of these keyframes at these poses, identical to a map
  /// drawn from scratch.
  void update(std::span<const KeyframePtr> keyframes, std::span<const types::Se2> poses);

  [[nodiscard]] const grid::OccupancyGrid& grid() const { return shown_.grid; }
  [[nodiscard]] const walls::WallStore& walls() const { return shown_.walls; }

 private:
  /// The map at one set of poses.
  struct Version {
    grid::OccupancyGrid grid;
    walls::WallStore walls;
    std::vector<types::Se2> drawn;  ///< poses at which the keyframes in it are drawn
  };
  bool is_drawn_well(const Version& version, std::size_t i, const types::Se2& pose) const;
  void draw(Version& version, std::size_t i, const Keyframe& keyframe, const types::Se2& pose);

  GridParams params_;
  patricia::Arena<grid::TileRef> tile_arena_;
  patricia::Arena<walls::Slabs> column_arena_;
  grid::ScanRasteriser rasteriser_;
  Version shown_;
  std::optional<Version> next_;  ///< in preparation
  std::size_t prepared_ = 0;     ///< keyframes drawn in it within the parameters
  std::size_t settled_ = 0;      ///< keyframes drawn exactly in the shown map
  walls::ColumnLedger ledger_;   ///< of the version from which later ones are derived
};

}  // namespace topo::slam
