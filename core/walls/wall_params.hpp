// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace topo::walls {

struct WallParams {
  double bin_m = 0.10;      ///< bin of the projection across the wall
  double gap_max_m = 0.45;  ///< greatest gap within a run: less than half of the narrowest door, more than a
                            ///< pipe or a person hides
  double length_min_m = 1.0;  ///< paper section II-B
  int points_min = 8;         ///< a local maximum with fewer cells is noise
  double filled_min = 0.35;   ///< least fraction of a run's bins that contain cells
  double contrast_min = 2.2;  ///< least ratio to the cells of the lines beside it: excludes clutter
  friend bool operator==(const WallParams&, const WallParams&) = default;
};

}  // namespace topo::walls
