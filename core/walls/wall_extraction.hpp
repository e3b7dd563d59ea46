// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/types/geometry.hpp"
#include "core/walls/wall_params.hpp"
#include "core/walls/wall_store.hpp"

namespace topo::walls {

/// Centres of the store's cells whose heights make them a wall (is_wall).
std::vector<types::Vector2> wall_points(const WallStore& store, const WallHeights& params);

/// Line segments along the compass direction and across it, from the first to the last cell centre: local
/// maxima of both histograms, their cells split into contiguous runs (paper section II-B). A maximum is local
/// along the wall, too: a run is accepted if it is fuller than the runs beside it, so that walls
/// of two rooms need not share a line. In the map frame. The order of the points does not matter. Costs a
/// sort of the points within each bin.
std::vector<types::Segment> extract_walls(std::span<const types::Vector2> points, double compass_rad,
                                          const WallParams& params = {});

}  // namespace topo::walls
