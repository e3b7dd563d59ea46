// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/places/segmentation/box_counts.hpp"
#include "core/places/segmentation/place_map.hpp"
#include "core/places/segmentation/regions.hpp"

namespace topo::places {

/// Share of its own free space in a region's box. Occupied cells count against it in full, what is unknown or
/// other regions' by params.elsewhere_weight.
double density(const types::Rectangle& box, std::uint32_t own_cells, const BoxCounts& counts,
               double resolution_m, const PlaceParams& params);

/// Of the region's core, in metres.
double narrow_side(const Region& region);

/// Longer than twice its width, and that width is what its clearance says: not a slice of a hall.
bool is_corridor(const Region& region);

/// Condition 2 of paper section II-C: what wall there is between the two is little beside their open border.
bool no_wall_between(const Contact& contact, double resolution_m, const PlaceParams& params);

/// The passage between them is nearly as wide as at least one of them: no doorway.
bool no_narrows(const Region& a, const Region& b, const Contact& contact, double resolution_m,
                const PlaceParams& params);

/// Not a corridor that ends in something much wider.
bool similar_width(const Region& a, const Region& b, const Contact& contact, double resolution_m,
                   const PlaceParams& params);

/// Merges neighbours to a fixed point, the densest union first, of equally dense ones the largest; then gives
/// small regions to their neighbours, and again. Returns for every region the one that it has gone into.
std::vector<std::uint32_t> reduce(std::vector<Region>& regions, const BoxCounts& counts, double resolution_m,
                                  const PlaceParams& params);

}  // namespace topo::places
