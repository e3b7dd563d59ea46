// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/places/segmentation/place_map.hpp"
#include "core/places/segmentation/regions.hpp"

namespace topo::places {

/// Where two corridors meet at a corner, the corner pieces are in line with both, and a single cell may
/// decide which of the two the reduction chooses. Assigns each such piece to the larger corridor, so that a
/// building has the same places whatever its orientation and furniture. `pieces`: the regions before the
/// reduction. `places`: the place of each piece, as the number of a piece; updated. True when a piece was
/// moved.
bool settle_corners(const std::vector<Region>& pieces, std::vector<std::uint32_t>& places,
                    double resolution_m, const PlaceParams& params);

/// The regions of places as far as a place map needs them: box, sum, cells, first cell, clearance, and the
/// sums of the borders' contacts; neither core nor passages. Each region has the number of its place; the
/// other regions are empty.
std::vector<Region> joined(const std::vector<Region>& pieces, const std::vector<std::uint32_t>& places);

}  // namespace topo::places
