// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/grid/dense_map.hpp"

namespace topo::bench {

/// The map turned counter-clockwise about the middle of its array, which grows to hold it: every cell has the
/// state of the cell that its centre comes from, as when a picture is turned without blending. Its border is
/// unknown. An empty map stays empty.
grid::DenseMap turned_map(const grid::DenseMap& map, double turn_rad);

/// Both maps in one, the second to the right of the first, with unknown cells between them. Of one
/// resolution.
grid::DenseMap side_by_side(const grid::DenseMap& left, const grid::DenseMap& right);

}  // namespace topo::bench
