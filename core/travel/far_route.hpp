// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/grid/wavefront.hpp"
#include "core/travel/coarse_map.hpp"

namespace topo::travel {

/// The way to a cell at the other end of a building, without searching all of the building: the coarse map
/// (`coarser`) says where ways may lead that are hardly dearer than the cheapest, and the fine map is
/// searched there only. Keeps its memory; one thread.
class FarRoute {
 public:
  /// From `coarse_field.start` to `target`, as grid::route_to. `coarse_field` is the whole travel field of
  /// the coarse map from the cell that `start` is in. Empty where there is no such way: there may still be
  /// one that the coarse map does not have. Costs two searches of the coarse map, and the cells beside the
  /// way.
  std::vector<grid::CellIndex> find(const grid::DenseMap& map, std::span<const float> clearance_m,
                                    const CoarseMap& coarse, const grid::TravelField& coarse_field,
                                    grid::CellIndex start, grid::CellIndex target,
                                    const grid::TravelRules& rules);

 private:
  grid::TravelSearch search_;
  grid::TravelField back_, field_;
  CoarseMap corridor_;
};

}  // namespace topo::travel
