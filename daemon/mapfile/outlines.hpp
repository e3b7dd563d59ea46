// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"

namespace topo::daemon {

/// Corners of cells, the first one not repeated at the end; the lower left corner of cell (0, 0) is (0, 0).
using Ring = std::vector<grid::CellIndex>;

/// The boundary of every label's cells along the cells' sides, corners only. Index k - 1 holds the rings of
/// label k, outer rings counter-clockwise and holes clockwise. Cells that touch at a corner alone are parted,
/// and no ring meets a corner twice. Linear in the number of cells. `labels` is parallel to map.cells, with 0
/// at the array's border.
std::vector<std::vector<Ring>> outlines_of(const grid::DenseMap& map, std::span<const std::uint16_t> labels,
                                           std::size_t label_count);

/// Groups the rings of one label by connected parts, the largest first: each part's outer ring, then its
/// holes.
std::vector<std::vector<Ring>> parts_of(std::vector<Ring> rings);

}  // namespace topo::daemon
