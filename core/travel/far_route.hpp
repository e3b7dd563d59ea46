// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/grid/wavefront.hpp"
#include "core/travel/coarse_map.hpp"
#include "core/travel/params.hpp"

namespace topo::travel {

/// Finds the route to a distant cell without a search of the whole building: the coarse map (`coarser`)
/// limits the search of the fine map to the cells of routes that cost little more than the cheapest. Keeps
/// its memory between calls; used by one thread.
class FarRoute {
 public:
  /// The route from `start` to `target`, as grid::route_to. `coarse_field` is the complete travel field of
  /// the coarse map from the cell that contains `start`. Empty when there is no such route; one that the
  /// coarse map does not contain may still exist. Costs one bounded search of the coarse map, and a search of
  /// the fine cells beside the route.
  std::vector<grid::CellIndex> find(const grid::DenseMap& map, std::span<const float> clearance_m,
                                    const CoarseMap& coarse, const grid::TravelField& coarse_field,
                                    grid::CellIndex start, grid::CellIndex target,
                                    const grid::TravelRules& rules, const FarRouteParams& params);

 private:
  grid::TravelSearch search_;
  grid::TravelField back_, field_;
  CoarseMap corridor_;
};

}  // namespace topo::travel
