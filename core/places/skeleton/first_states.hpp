// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/places/skeleton/thinning_state.hpp"

namespace topo::places {

/// Assumes for all free cells that those not on the ridge are removed at their turn. `states` must be zero,
/// and as long as map.cells. Returns the cells for which the assumption does not hold, ascending. One pass
/// over the cells.
std::vector<std::uint32_t> assume_states(const grid::DenseMap& map, std::span<const float> clearance_m,
                                         std::vector<ThinningState>& states);

}  // namespace topo::places
