// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"

namespace topo::places {

/// A junction or an end of the skeleton.
struct SkeletonNode {
  grid::CellIndex cell;
  float clearance_m = 0.0F;
  int degree = 0;
};

struct SkeletonEdge {
  std::uint32_t a = 0;  ///< nodes; may be the same for a loop
  std::uint32_t b = 0;
  float length_m = 0.0F;
  float clearance_min_m = 0.0F;  ///< at its narrowest
};

/// One-pixel medial axis of the free space with as many components and holes as that, and its graph (paper
/// section II-C).
struct Skeleton {
  std::vector<std::uint8_t> on;  ///< 1 on the axis; as long as map.cells
  std::vector<SkeletonNode> nodes;
  std::vector<SkeletonEdge> edges;
};

/// `clearance_m`: grid::clearance_m of the map with kOccupiedOrUnknown.
Skeleton skeletonise(const grid::DenseMap& map, std::span<const float> clearance_m);

}  // namespace topo::places
