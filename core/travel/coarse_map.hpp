// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"

namespace topo::travel {

/// A map and its distance map with kOccupiedOrUnknown.
struct CoarseMap {
  grid::DenseMap map;
  std::vector<float> clearance_m;
};

/// The same in cells 2^`doublings` as wide: occupied when one of a cell's is, else free when one is. A free
/// cell's clearance is the most of them, so that a way is as wide as it was. Costs one pass over the cells.
CoarseMap coarser(const grid::DenseMap& map, std::span<const float> clearance_m, int doublings = 1);

}  // namespace topo::travel
