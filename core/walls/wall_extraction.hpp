// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/types/geometry.hpp"
#include "core/walls/wall_store.hpp"

namespace topo::walls {

struct WallParams {
  double bin_m = 0.10;      ///< bin of the projection across the wall
  double gap_max_m = 0.45;  ///< a run goes on over a smaller gap: less than half of the narrowest door, more
                            ///< than what a pipe or a person hides
  double length_min_m = 1.0;  ///< paper section II-B
  int points_min = 8;         ///< a local maximum with fewer cells is noise
  double filled_min = 0.35;   ///< share of a run's length that cells were seen on
  double contrast_min = 2.2;  ///< so many times the cells of the lines beside it: clutter is no wall
};

/// Centres of the store's cells that are wall by their heights (is_wall).
std::vector<types::Vector2> wall_points(const WallStore& store);

/// Centres of the occupied cells on the surface of what is occupied: a side of theirs is not. The inside of a
/// solid mass, as drawn maps have it, says nothing of walls, and can be most of the map.
std::vector<types::Vector2> occupied_points(const grid::DenseMap& map);

/// Line segments along the compass direction and across it, from cell centre to cell centre: local maxima of
/// both histograms, their cells broken into contiguous runs (paper section II-B). A maximum is local along
/// the wall, too: a run stands if it is fuller than what runs beside it within 0.2 m, so that walls of two
/// rooms need not share a line. In map. The order of the points does not matter. Costs a sort of the points
/// within each bin.
std::vector<types::Segment> extract_walls(std::span<const types::Vector2> points, double compass_rad,
                                          const WallParams& params = {});

}  // namespace topo::walls
