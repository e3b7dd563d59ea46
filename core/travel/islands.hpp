// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/grid/dense_map.hpp"

namespace topo::travel {

/// The map without what stands free and is at most `side_m` long and wide, as a person, a robot or a chair,
/// which may go away, and no wall: such pieces of occupied cells (eight neighbours) are free, and so are the
/// unknown cells within `side_m` of one, since it is seen from one side. Cost: one pass over the cells.
grid::DenseMap without_islands(const grid::DenseMap& map, double side_m);

}  // namespace topo::travel
