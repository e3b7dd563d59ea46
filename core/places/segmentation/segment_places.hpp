// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/grid/dense_map.hpp"
#include "core/places/segmentation/first_labels.hpp"
#include "core/places/segmentation/place_map.hpp"
#include "core/places/skeleton/skeleton.hpp"

namespace topo::places {

/// The second half of the segmentation: merges neighbours to a fixed point under the two conditions of paper
/// section II-C: the union's box in the compass frame is mostly free, and no wall is crossed. Independent of
/// the order of nodes. Without a compass, the map's own axes apply.
PlaceMap reduce_labels(const grid::DenseMap& map, std::span<const float> clearance_m,
                       const FirstLabels& first, std::span<const types::Segment> walls, double compass_rad,
                       const PlaceParams& params = {});

/// First labels and reduction together.
PlaceMap segment_places(const grid::DenseMap& map, std::span<const float> clearance_m,
                        const Skeleton& skeleton, std::span<const types::Segment> walls, double compass_rad,
                        const PlaceParams& params = {});

}  // namespace topo::places
