// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/walls/height_column.hpp"

namespace topo::walls {

/// Extraction of walls from cells. No source is recorded for the values that name none.
struct WallParams {
  WallHeights heights;
  double bin_m = 0.10;      ///< bin of the projection across the wall
  double gap_max_m = 0.45;  ///< greatest gap within a run: less than half of the narrowest door, more than a
                            ///< pipe or a person hides
  double length_min_m = 1.0;  ///< paper section II-B
  int points_min = 8;         ///< a local maximum with fewer cells is noise
  double filled_min = 0.35;   ///< least fraction of a run's bins that contain cells
  double contrast_min = 2.2;  ///< least ratio to the cells of the lines beside it: excludes clutter
  /// Half bins to each side in which a run beside a fuller one belongs to the same wall: two bins, the
  /// thickness of a partition seen from both sides.
  int same_wall_half_bins = 4;
  /// Begin and width, in half bins on each side, of the band whose density a wall must exceed. Nearer half
  /// bins may belong to the wall itself.
  int band_from_half_bins = 3;
  int band_half_bins = 6;
  friend bool operator==(const WallParams&, const WallParams&) = default;
};

}  // namespace topo::walls
