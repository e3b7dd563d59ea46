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

/// The cells whose label hangs on one of these, each with another slope than before or another relation to
/// the axis, none at the array's border. They are marked kVisited in `slopes`; returned is where they are.
///
/// A cell's label hangs on the way up from it to the axis; where that way is flat, on which neighbours were
/// labelled before, and so on the ways that lead to those. Both go from cell to cell along slopes and across
/// what is flat, and none goes through the axis. So whatever is connected in this manner, up and down, with a
/// cell that has changed or was beside it is labelled anew, and nothing else.
grid::CellBlocks find_basins(const grid::DenseMap& map, std::span<const std::uint32_t> changed,
                             std::vector<Slope>& slopes);

}  // namespace topo::places
