// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/cell_blocks.hpp"
#include "core/grid/dense_map.hpp"
#include "core/places/segmentation/slopes.hpp"

namespace topo::places {

/// The cells whose label depends on one of the `changed` cells: the watershed basins of those. Each of
/// `changed` has another slope or another relation to the axis than before; none is at the array's border.
/// Marks the cells kVisited in `slopes`; returns their positions.
///
/// A cell's label depends on the ascent from it to the axis; where the ascent is flat, it depends on the
/// neighbours labelled before, and so on the ascents that lead to these. Both run from cell to cell along
/// slopes and over flat cells, and none runs through the axis. So exactly the cells connected in this manner,
/// up and down, with a changed cell or a neighbour of one must be labelled again.
grid::CellBlocks find_basins(const grid::DenseMap& map, std::span<const std::uint32_t> changed,
                             std::vector<Slope>& slopes);

}  // namespace topo::places
