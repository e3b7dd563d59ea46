// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/types/geometry.hpp"
#include "core/walls/wall_lines.hpp"
#include "core/walls/wall_params.hpp"
#include "core/walls/wall_store.hpp"

namespace topo::walls {

/// Centres of the store's cells that are wall by their heights (is_wall).
std::vector<types::Vector2> wall_points(const WallStore& store);

/// Line segments along the compass direction and across it, from cell centre to cell centre: local maxima of
/// both histograms, their cells broken into contiguous runs (paper section II-B). A maximum is local along
/// the wall, too: a run stands if it is fuller than what runs beside it within 0.2 m, so that walls of two
/// rooms need not share a line. In map. The order of the points does not matter. Costs a sort of the points
/// within each bin.
std::vector<types::Segment> extract_walls(std::span<const types::Vector2> points, double compass_rad,
                                          const WallParams& params = {});

/// What one extraction leaves to the next.
struct WallMemory {
  WallParams params;
  std::array<WallLines, 2> lines;  ///< of what runs along the compass, and across it
};

/// The same, equal to the bit, from what the extraction of other points left, and leaves it of these.
/// `points`: how they differ from those; of no meaning when there were none. Costs what has changed, and a
/// copy of the rest, while the compass stays the same and the box of the points in its frame.
std::vector<types::Segment> extract_walls(const compass::PointsChange& points, double compass_rad,
                                          const WallParams& params, WallMemory& memory);

}  // namespace topo::walls
