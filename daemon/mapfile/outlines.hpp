// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"

namespace topo::daemon {

/// Corners of cells, the first one not repeated at the end; cell (0, 0) has its lower left corner at (0, 0).
using Ring = std::vector<grid::CellIndex>;

/// The boundary of every label's cells along the sides of cells, corners only: for label k at index k - 1 its
/// rings, outer ones counter-clockwise and holes clockwise. Cells that touch over a corner belong together.
/// Linear in the cells. `labels` as map.cells, with 0 at the array's border.
std::vector<std::vector<Ring>> outlines_of(const grid::DenseMap& map, std::span<const std::uint16_t> labels,
                                           std::size_t label_count);

/// The same rings of one label by its connected parts, the largest first: of each the outer ring, then its
/// holes.
std::vector<std::vector<Ring>> parts_of(std::vector<Ring> rings);

}  // namespace topo::daemon
