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

/// Share of a region's own free space in its box. Occupied cells count against it in full, cells that are
/// unknown or of other regions by params.density.elsewhere_weight.
double density(const types::Rectangle& box, std::uint32_t own_cells, const BoxCounts& counts,
               double resolution_m, const PlaceParams& params);

/// Shorter side of the region's core, in metres.
double narrow_side(const Region& region);

/// True when the region is much longer than wide, and its clearance matches its width.
bool is_corridor(const Region& region, const CorridorParams& params);

/// Condition 2 of paper section II-C: there is little wall between the two regions compared with their open
/// border.
bool no_wall_between(const Contact& contact, double resolution_m, const PlaceParams& params);

/// True when the passage between them is nearly as wide as at least one of them, so that it is no doorway.
bool no_narrows(const Region& a, const Region& b, const Contact& contact, double resolution_m,
                const PlaceParams& params);

/// False for a corridor that ends in something much wider.
bool similar_width(const Region& a, const Region& b, const Contact& contact, double resolution_m,
                   const PlaceParams& params);

/// Merges neighbours to a fixed point, the densest union first, and the largest first among equally dense
/// ones; then gives small regions to their neighbours, and repeats. Returns for every region the one that
/// contains it.
std::vector<std::uint32_t> reduce(std::vector<Region>& regions, const BoxCounts& counts, double resolution_m,
                                  const PlaceParams& params);

}  // namespace topo::places
