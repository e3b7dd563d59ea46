// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "tests/sim/raster.hpp"

namespace topo::sim {

/// Border between a solid piece and the free cells, solid on the left (outer borders counter-clockwise).
struct Contour {
  Polygon outline;      ///< metres
  std::uint32_t piece;  ///< number of its solid piece
};

/// Solid pieces joined over sides and corners.
struct Pieces {
  std::vector<std::uint32_t> label;   ///< per cell of the raster; 0 = free
  std::vector<types::Rectangle> box;  ///< of piece i, metres; element 0 unused
  std::vector<bool> at_border;        ///< touches the raster's border: belongs to the outside
};

Pieces label_pieces(const Raster& solid);

/// Borders through the middles of the cell sides, straightened where they stay within `tolerance_cells` of
/// those middles: walls at any angle become straight lines instead of stairs. Everything outside the raster
/// is solid.
std::vector<Contour> trace_contours(const Raster& solid, const Pieces& pieces, double tolerance_cells);

/// Splits a closed line where it deviates from straight parts by more than the tolerance (Douglas and Peucker
/// 1973), fits a line to every part and joins the lines: right angles become sharp, slanted walls straight.
/// Small outlines do not change.
Polygon straighten(const Polygon& outline, double tolerance_m);

}  // namespace topo::sim
