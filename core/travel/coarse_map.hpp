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

/// The same map in cells 2^`doublings` times as wide: occupied when one of the fine cells is occupied, else
/// free when one is free. The clearance of a free cell is the largest of the fine cells, so that passages
/// keep their width. Costs one pass over the cells.
CoarseMap coarser(const grid::DenseMap& map, std::span<const float> clearance_m, int doublings = 1);

}  // namespace topo::travel
