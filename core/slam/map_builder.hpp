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

/// Draws keyframes into the grid and the wall store, and again where they moved. The result is a function of
/// the keyframes and the poses they were drawn at. Where many moved, the map at their new poses is prepared
/// beside the one that is shown, a piece at a time, so that nobody waits for it and nobody sees half of it.
/// Belongs to the thread that made it, or that called adopt().
class MapBuilder {
 public:
  explicit MapBuilder(const GridParams& params);

  /// Makes the calling thread the owner of all nodes.
  void adopt();

  /// Draws the keyframes that came since into the map that is shown.
  void extend(std::span<const KeyframePtr> keyframes, std::span<const types::Se2> poses);

  /// Draws towards the map of these keyframes at these poses, which is begun when none is in preparation.
  /// Costs those that are new or that moved more than the parameters say, of them as many as see `beams_max`
  /// beams and columns together, and one at least. True when all are drawn. Until show(), the poses of those
  /// that were in a call before stay the same.
  bool prepare(std::span<const KeyframePtr> keyframes, std::span<const types::Se2> poses,
               std::size_t beams_max);

  /// The map in preparation takes the place of the one that is shown.
  void show();

  /// Draws the shown map to the cell: keyframes that lie less than the parameters say from where they were
  /// drawn, of them as many as see `beams_max` beams and columns together, and one at least. True when none
  /// is left. Nothing while a map is in preparation. `poses` are those of the map that was shown last, and of
  /// what extended it.
  bool settle(std::span<const KeyframePtr> keyframes, std::span<const types::Se2> poses,
              std::size_t beams_max);

  /// All of it at once, to the cell: the map of these keyframes at these poses is shown, the same as if they
  /// had been drawn nowhere before.
  void update(std::span<const KeyframePtr> keyframes, std::span<const types::Se2> poses);

  [[nodiscard]] const grid::OccupancyGrid& grid() const { return shown_.grid; }
  [[nodiscard]] const walls::WallStore& walls() const { return shown_.walls; }

 private:
  /// The map at one set of poses.
  struct Version {
    grid::OccupancyGrid grid;
    walls::WallStore walls;
    std::vector<types::Se2> drawn;  ///< poses of the keyframes in it
  };
  bool is_drawn_well(const Version& version, std::size_t i, const types::Se2& pose) const;
  void draw(Version& version, std::size_t i, const Keyframe& keyframe, const types::Se2& pose);

  GridParams params_;
  patricia::Arena<grid::TileRef> tile_arena_;
  patricia::Arena<walls::Slabs> column_arena_;
  grid::ScanRasteriser rasteriser_;
  Version shown_;
  std::optional<Version> next_;  ///< in preparation
  std::size_t prepared_ = 0;     ///< keyframes that are drawn well in it
  std::size_t settled_ = 0;      ///< keyframes that are drawn to the cell in the shown map
  walls::ColumnLedger ledger_;   ///< of the version that later ones are made from
};

}  // namespace topo::slam
