// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/places/segmentation/place_map.hpp"
#include "core/places/segmentation/regions.hpp"

namespace topo::places {

/// Where two corridors meet at a corner, its pieces are in line with both, and which of the two the reduction
/// gave them hangs on a cell. Gives each to the larger one, so that the same building has the same places
/// however it is turned or furnished. `pieces`: the regions before the reduction; `places`: for each its
/// place, a number of a piece; changed. True when a piece was moved.
bool settle_corners(const std::vector<Region>& pieces, std::vector<std::uint32_t>& places,
                    double resolution_m, const PlaceParams& params);

/// The regions of places as far as a place map is made of them: box, sum, cells, first cell, clearance and
/// the borders' sums of contacts; no core, no passages. Each under the number of its place, the others empty.
std::vector<Region> joined(const std::vector<Region>& pieces, const std::vector<std::uint32_t>& places);

}  // namespace topo::places
